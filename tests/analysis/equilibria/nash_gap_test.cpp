#include "analysis/play/naive.h"
#include "analysis/replies/value_iteration.h"
#include "cases.h"

#include <folk/analysis/equilibria/nash_gap.h>
#include <gtest/gtest.h>

#include <cmath>

namespace folk {
namespace {

/// The best total of `left` rounds over all sequences of moves, round t weighing continuation^t.
double by_enumeration(const Automaton& opponent, State state, double continuation, int left) {
  constexpr std::array<double, 4> payoffs{3, 0, 5, 1};
  if (left == 0) return 0;
  const Move theirs = move_of(opponent, state);
  double best = 0;
  for (const Move own : {Move::C, Move::D})
    best = std::max(
        best, payoffs[Outcome{own, theirs}.index()] +
                  continuation * by_enumeration(opponent, opponent.next(state, theirs, own), continuation, left - 1));
  return best;
}

double paid_naively(const Automaton& own, const Automaton& theirs, const Criterion& criterion) {
  constexpr std::array<double, 4> payoffs{3, 0, 5, 1};
  const auto rounds = static_cast<std::uint64_t>(test::sweeps_of(criterion));
  const auto weights = test::play_naively(own, theirs, rounds, criterion.continuation());
  double sum = 0;
  for (std::size_t o = 0; o < 4; ++o) sum += weights[o] * payoffs[o];
  return test::round_weight(criterion) * sum;
}

/// Pairs of up to 8 states; gaps to 1e-9. For d <= 0.5 also against every sequence of 12 moves, the rest weighing at
/// most 5 d^12.
TEST(NashGap, Of10000RandomPairsEqualsValueIterationAndEnumeration) {
  RandomStream random({31, 0, 0, 0});
  constexpr std::array criteria{"discounted:0.2", "discounted:0.5", "discounted:0.8", "discounted:1/3", "ending:0.5"};
  for (int i = 0; i < test::cases(10'000); ++i) {
    const Automaton own = test::random_automaton(random, 8, true);
    const Automaton theirs = test::random_automaton(random, 8, true);
    const auto criterion = Criterion::parse(criteria[random() % criteria.size()]);
    const Gap gap = nash_gap(play_path(own, theirs, criterion), theirs, {}, criterion);
    ASSERT_TRUE(gap.exact);
    const double paid = paid_naively(own, theirs, criterion);
    const double iterated = test::reply_values(theirs, {}, criterion)[theirs.start()];
    ASSERT_NEAR(gap.gain, iterated - paid, 1e-9) << i;
    ASSERT_EQ(gap.gain > 0, gap.witness.deviation.has_value());
    if (criterion.continuation() > 0.5) continue;
    constexpr int rounds = 12;
    const double d = criterion.continuation();
    const double weight = test::round_weight(criterion);
    const double enumerated = weight * by_enumeration(theirs, theirs.start(), d, rounds);
    ASSERT_GE(gap.gain, enumerated - paid - 1e-9) << i;
    ASSERT_LE(gap.gain, enumerated - paid + weight * 5 * std::pow(d, rounds) / (1 - d) + 1e-9) << i;
  }
}

/// The code for machines that mix, asked about machines that do not.
TEST(NashGap, OfChanceAgreesWithTheExactOneOn1000PurePairs) {
  RandomStream random({32, 0, 0, 0});
  constexpr std::array criteria{"finite:1", "finite:20", "discounted:0.9", "ending:0.3", "mean"};
  for (int i = 0; i < 1000; ++i) {
    const Automaton own = test::random_automaton(random, 6, true);
    const Automaton theirs = test::random_automaton(random, 6, true);
    const auto criterion = Criterion::parse(criteria[random() % criteria.size()]);
    const Gap exact = nash_gap(play_path(own, theirs, criterion), theirs, {}, criterion);
    const Gap rounded = nash_gap(own, theirs, {{}, criterion});
    ASSERT_NEAR(exact.gain, rounded.gain, rounded.residual + 1e-11) << criterion.to_string() << " case " << i;
    ASSERT_LE(rounded.residual, 1e-9);
  }
}

TEST(NashGap, NamesADepartureAfterSomeLapsOfTheCycle) {
  // Cooperates until it has cooperated three times, then answers D with mercy: only there does the reply defect.
  const Automaton patient({{1, {1, 1, 1, 1}}, {1, {2, 2, 2, 2}}, {1, {0, 0, 0, 0}}}, 0);
  const Automaton all_c({{1, {0, 0, 0, 0}}}, 0);
  const auto criterion = Criterion::discounted(0.5);
  const PlayPath path = play_path(all_c, patient, criterion);
  const PathPayoffs paid(path, {}, criterion);
  // A reply of another opponent, who rewards cooperation in its first ten rounds alone.
  std::vector<Automaton::Node> nodes;
  for (std::uint32_t s = 0; s < 10; ++s) nodes.push_back({1, {s + 1, s + 1, 10, 10}});
  nodes.push_back({0, {10, 10, 10, 10}});
  BestReply reply{4, Rational(4), 0, std::nullopt, Automaton(std::move(nodes), 0)};
  const Gap gap = reply_gap(path, paid, reply);
  EXPECT_EQ(*gap.exact, 1);
  EXPECT_EQ(gap.witness.history.size(), 10U);
  EXPECT_EQ(gap.witness.deviation, Move::D);
}

}  // namespace
}  // namespace folk
