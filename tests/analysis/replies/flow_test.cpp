#include <folk/analysis/replies/flow.h>
#include <folk/games/random.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace folk {
namespace {

constexpr std::array endless_criteria{"discounted:1/2",  "discounted:2/3",         "discounted:0.99",
                                      "discounted:1e-9", "discounted:0.999999999", "ending:1",
                                      "ending:0.25",     "ending:1e-15",           "mean"};

struct RandomFlow {
  std::vector<std::uint32_t> next;
  std::vector<double> rewards;
};

/// Few rewards, so that courses often pay alike without meeting.
RandomFlow random_flow(RandomStream& random) {
  const auto below = [&](std::uint32_t n) { return static_cast<std::uint32_t>(random() % n); };
  const std::uint32_t size = 1 + below(9);
  const std::uint32_t kinds = 1 + below(3);
  RandomFlow flow;
  for (std::uint32_t s = 0; s < size; ++s) {
    flow.next.push_back(below(size));
    flow.rewards.push_back(static_cast<double>(below(kinds)) * 7 - 5);
  }
  return flow;
}

Rational weight_of(const Criterion& criterion) {
  return criterion.kind() == Criterion::Kind::discounted ? Rational(1 - criterion.exact_continuation()) : Rational(1);
}

TEST(Flow, ValuesSolveTheirOwnEquationExactlyIn2000RandomFlows) {
  RandomStream random({1, 0, 0, 0});
  for (int i = 0; i < 2000; ++i) {
    const auto criterion = Criterion::parse(endless_criteria[random() % endless_criteria.size()]);
    const auto [next, rewards] = random_flow(random);
    const Flow flow(next, rewards, 3, criterion);
    for (std::uint32_t s = 0; s < flow.size(); ++s) {
      const Rational after = flow.value(next[s]);
      const Rational value = flow.value(s);
      const double error = std::abs(to_double(value) - flow.values()[s]);
      ASSERT_LE(error, flow.doubt()) << criterion.to_string();
      if (criterion.kind() == Criterion::Kind::mean) {
        ASSERT_EQ(value, after);
        continue;
      }
      ASSERT_EQ(value, weight_of(criterion) * Rational(static_cast<int>(rewards[s])) / 3 +
                           criterion.exact_continuation() * after);
    }
  }
}

TEST(Flow, GainsAreDifferencesOfValuesIn2000RandomFlows) {
  RandomStream random({2, 0, 0, 0});
  int ties = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto criterion = Criterion::parse(endless_criteria[random() % endless_criteria.size()]);
    const auto [next, rewards] = random_flow(random);
    const Flow flow(next, rewards, 3, criterion);
    for (std::uint32_t s = 0; s < flow.size(); ++s) {
      const auto instead = static_cast<std::uint32_t>(random() % flow.size());
      const double reward = rewards[random() % flow.size()];
      const Rational gain = flow.gain(s, reward, instead);
      const bool mean = criterion.kind() == Criterion::Kind::mean;
      if (mean) {
        ASSERT_EQ(gain, flow.value(instead) - flow.value(s));
      } else {
        ASSERT_EQ(gain, weight_of(criterion) * Rational(static_cast<int>(reward)) / 3 +
                            criterion.exact_continuation() * flow.value(instead) - flow.value(s));
      }
      ASSERT_EQ(flow.gain_sign(s, reward, instead), gain.sign());
      const double rounded = flow.rounded_gain(s, reward, instead);
      ASSERT_LE(std::abs(rounded - to_double(gain)), flow.doubt()) << criterion.to_string();
      ties += gain == 0 ? 1 : 0;
    }
  }
  EXPECT_GT(ties, 1000);
}

TEST(Flow, TellsPeriodicCoursesThatPayAlikeFromThoseThatDoNot) {
  // 0: 1 0 1 0 ... in two states; 2: the same in four; 6: the same in six but for the last round of the lap.
  const std::vector<std::uint32_t> next{1, 0, 3, 4, 5, 2, 7, 8, 9, 10, 11, 6};
  const std::vector<double> rewards{1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 1};
  const Flow flow(next, rewards, 1, Criterion::discounted(0.5));
  EXPECT_EQ(flow.gain_sign(0, 1, 3), 0);
  EXPECT_EQ(flow.gain_sign(0, 1, 7), 1);
  // The first difference comes in the sixth round, once every six.
  EXPECT_EQ(flow.gain(0, 1, 7), Rational(1, 2) * Rational(1, 32) / (1 - Rational(1, 64)));
}

TEST(Flow, IsExactWithTheLargestRewardsAndScales) {
  const Rational scale = parse_rational("1e30");  // no double is this number
  const Flow flow({0, 1}, {0x1p53, 1 - 0x1p53}, scale, Criterion::discounted(0.5));
  EXPECT_EQ(flow.value(0), Rational(1LL << 53) / scale);
  // The two rewards differ by 2^54 - 1, which no double is either.
  EXPECT_EQ(flow.gain(1, 0x1p53, 1), Rational((1LL << 54) - 1) / scale / 2);
}

TEST(Flow, OfFiniteCriteriaIsRefused) { EXPECT_THROW(Flow({0}, {1}, 1, Criterion::finite(3)), std::logic_error); }

}  // namespace
}  // namespace folk
