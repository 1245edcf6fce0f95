#include "analysis/play/naive.h"
#include "analysis/replies/value_iteration.h"
#include "cases.h"

#include <folk/analysis/equilibria/nash_gap.h>
#include <folk/analysis/equilibria/self_confirming_gap.h>
#include <folk/strategies/registry.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <memory>

namespace folk {
namespace {

constexpr std::array<double, 4> numbers{3, 0, 5, 1};

/// The best payoff along the path when every departure from it is followed by 1, the minmax, for ever: backwards from
/// the last round, or by value iteration around the cycle.
double best_along(const PlayPath& path, const Criterion& criterion) {
  const double d = criterion.continuation();
  const double weight = test::round_weight(criterion);
  const std::size_t n = path.rounds.size();
  if (criterion.kind() == Criterion::Kind::mean) {
    double sum = 0;
    for (std::size_t t = *path.cycle; t < n; ++t) sum += numbers[path.rounds[t].index()];
    return std::max(1.0, sum / static_cast<double>(n - *path.cycle));
  }
  std::vector<double> values(n + 1);
  const int sweeps = criterion.is_finite() ? 1 : test::sweeps_of(criterion);
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    if (path.cycle) values[n] = values[*path.cycle];
    for (std::size_t t = n; t-- > 0;) {
      const auto [own, theirs] = path.rounds[t];
      const double punished = criterion.is_finite() ? static_cast<double>(n - t - 1) : d * weight / (1 - d);
      values[t] = std::max(weight * numbers[Outcome{own, theirs}.index()] + d * values[t + 1],
                           weight * numbers[Outcome{other(own), theirs}.index()] + punished);
    }
  }
  return values[0];
}

/// Pairs of up to 8 states; gaps to 1e-9.
TEST(UnrestrictedGap, IsTheBestReplyWhenMinmaxLiesOffThePathIn10000RandomPairs) {
  RandomStream random({51, 0, 0, 0});
  constexpr std::array criteria{"finite:1",       "finite:13",  "discounted:0.3", "discounted:0.6",
                                "discounted:0.9", "ending:0.2", "ending:1",       "mean"};
  int none = 0;
  for (int i = 0; i < test::cases(10'000); ++i) {
    const Automaton own = test::random_automaton(random, 8, true);
    const Automaton theirs = test::random_automaton(random, 8, true);
    const auto criterion = Criterion::parse(criteria[random() % criteria.size()]);
    const PlayPath path = play_path(own, theirs, criterion);
    const Gap gap = unrestricted_gap(path, {}, criterion);
    ASSERT_TRUE(gap.exact);
    const double paid = PathPayoffs(path, {}, criterion).rounded_from(0);
    ASSERT_NEAR(gap.gain, best_along(path, criterion) - paid, 1e-9) << criterion.to_string() << " case " << i;
    none += gap.gain == 0 ? 1 : 0;
  }
  EXPECT_GT(none, 100);
}

TEST(UnrestrictedGap, OfChanceAgreesWithTheExactOneOn1000PurePairs) {
  RandomStream random({52, 0, 0, 0});
  constexpr std::array criteria{"finite:1", "finite:12", "discounted:0.6", "discounted:0.99", "ending:0.2", "mean"};
  const std::array<Payoffs, 3> games{Payoffs{}, parse_payoffs("T=2.5,R=1/3,P=-1,S=-7/2"), Payoffs{0, 1, 1, 0}};
  for (int i = 0; i < 1000; ++i) {
    const Automaton own = test::random_automaton(random, 6, true);
    const Automaton theirs = test::random_automaton(random, 6, true);
    const auto criterion = Criterion::parse(criteria[random() % criteria.size()]);
    const Payoffs payoffs = games[random() % games.size()];
    const Gap exact = unrestricted_gap(play_path(own, theirs, criterion), payoffs, criterion);
    const Gap rounded = unrestricted_gap(own, theirs, payoffs, criterion);
    ASSERT_NEAR(exact.gain, rounded.gain, rounded.residual + 1e-11) << criterion.to_string() << " case " << i;
  }
}

TEST(UnrestrictedGap, MixesTheMinmaxWhereThatHurtsMore) {
  // In the game of chicken D alone holds a player to S; where both want to match, only a fair coin holds it to 1/2.
  EXPECT_EQ(mixed_minmax({4, 3, 0, 1}), 1);
  EXPECT_EQ(mixed_minmax({0, 1, 1, 0}), Rational(1, 2));
}

std::vector<Strategy> random_class(RandomStream& random, const Automaton& truth) {
  std::vector<Strategy> members;
  for (int i = 0; i < 6; ++i)
    members.push_back(
        {fmt::format("m{}", i), std::make_shared<Automaton>(test::random_automaton(random, 3, true)), {}});
  members.push_back({"truth", std::make_shared<Automaton>(truth), {}});
  return members;
}

/// Does the member play along with the pair for 100 rounds? Longer than all joint states of the three.
bool plays_along(const Machine& own, const Machine& theirs, const Machine& member, std::uint64_t rounds) {
  State x = own.start();
  State y = theirs.start();
  State z = member.start();
  for (std::uint64_t t = 0; t < rounds; ++t) {
    const Move a = move_of(own, x);
    const Move b = move_of(theirs, y);
    if (move_of(member, z) != b) return false;
    x = own.next(x, a, b);
    y = theirs.next(y, b, a);
    z = member.next(z, b, a);
  }
  return true;
}

TEST(ClassGap, IsTheLeastOverMembersThatPlayAlongIn1000RandomPairs) {
  RandomStream random({53, 0, 0, 0});
  constexpr std::array criteria{"finite:9", "discounted:0.6", "discounted:0.9", "mean"};
  int others = 0;
  for (int i = 0; i < 1000; ++i) {
    const Automaton own = test::random_automaton(random, 3, true);
    const Automaton theirs = test::random_automaton(random, 3, true);
    const auto criterion = Criterion::parse(criteria[random() % criteria.size()]);
    const auto members = random_class(random, theirs);
    const PlayPath path = play_path(own, theirs, criterion);
    const PathPayoffs paid(path, {}, criterion);
    std::optional<Rational> least;
    std::string name;
    for (const Strategy& member : members) {
      if (!plays_along(own, theirs, *member.machine, criterion.is_finite() ? 9 : 100)) continue;
      const Rational gain = *best_reply(*member.machine, {{}, criterion}).exact - paid.total();
      if (least && gain >= *least) continue;
      least = gain;
      name = member.name;
    }
    ClassReplies beliefs(members, {{}, criterion});
    const auto gap = class_gap(path, beliefs);
    ASSERT_TRUE(gap);
    ASSERT_EQ(*gap->exact, *least);
    ASSERT_EQ(gap->witness.belief, name);
    ASSERT_EQ(*class_gap(path, beliefs)->exact, *least);  // from the replies that were kept
    const auto rounded = class_gap(own, theirs, beliefs);
    ASSERT_TRUE(rounded);
    ASSERT_NEAR(rounded->gain, gap->gain, rounded->residual + 1e-11);
    others += name == "truth" ? 0 : 1;
  }
  EXPECT_GT(others, 100);
}

TEST(ClassGap, IsNothingWhereNoMemberPlaysAlong) {
  const Registry registry = Registry::standard();
  const auto all_c = registry.make("all_c");
  const auto criterion = Criterion::discounted(0.9);
  ClassReplies beliefs({registry.make("all_d")}, {{}, criterion});
  EXPECT_FALSE(class_gap(play_path(*all_c.machine, *all_c.machine, criterion), beliefs));
  ClassReplies empty({}, {{}, criterion});
  EXPECT_FALSE(class_gap(play_path(*all_c.machine, *all_c.machine, criterion), empty));
}

TEST(ClassGap, BoundsMembersWithoutEnd) {
  const Registry registry = Registry::standard();
  const auto all_c = registry.make("all_c");
  const auto at = [&](const Criterion& criterion) {
    ClassReplies beliefs({registry.make("gradual")}, {{}, criterion}, 30);
    return class_gap(play_path(*all_c.machine, *all_c.machine, criterion), beliefs);
  };
  EXPECT_EQ(at(Criterion::discounted(0.9))->depth, 30U);
  EXPECT_FALSE(at(Criterion::finite(10))->depth);
  // Under mean nothing is known of it.
  const auto unknown = at(Criterion::mean());
  ASSERT_TRUE(unknown);
  EXPECT_EQ(unknown->gain, 0);
  EXPECT_NE(unknown->tried.find("gradual"), std::string::npos);
}

/// Plays D for ever once it has met a D, and counts the rounds for nothing.
class CountingGrudge final : public Machine {
public:
  State start() const override { return 0; }
  double cooperation(State state) const override { return state % 2 == 0 ? 1 : 0; }
  State next(State state, Move, Move theirs) const override { return (state + 2) | bit(theirs); }
  bool finite() const override { return false; }
};

/// A bound that finds no gain leaves the question open; an exact 0 of another member closes it.
TEST(ClassGap, TakesTheExactOneOfEqualGaps) {
  const Registry registry = Registry::standard();
  const auto all_c = registry.make("all_c");
  const auto criterion = Criterion::discounted(0.9);
  const Strategy counting{"counting", std::make_shared<CountingGrudge>(), {}};
  const Strategy spiteful = registry.make("spiteful");
  const Strategy tit_for_tat = registry.make("tit_for_tat");
  const auto gap_over = [&](std::vector<Strategy> members) {
    ClassReplies beliefs(std::move(members), {{}, criterion}, 10);
    return *class_gap(play_path(*all_c.machine, *all_c.machine, criterion), beliefs);
  };
  const Gap bound = gap_over({counting});
  EXPECT_EQ(bound.gain, 0);
  EXPECT_EQ(bound.depth, 10U);
  for (const auto& members : {std::vector{counting, spiteful, tit_for_tat}, {spiteful, counting, tit_for_tat}}) {
    const Gap gap = gap_over(members);
    EXPECT_EQ(gap.exact, Rational(0));
    EXPECT_FALSE(gap.bounded());
    EXPECT_EQ(gap.witness.belief, "spiteful");
  }
}

}  // namespace
}  // namespace folk
