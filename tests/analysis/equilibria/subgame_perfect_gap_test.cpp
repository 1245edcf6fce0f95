#include "analysis/play/naive.h"
#include "analysis/replies/value_iteration.h"
#include "cases.h"

#include <folk/analysis/equilibria/subgame_perfect_gap.h>
#include <folk/games/error.h>
#include <folk/strategies/registry.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

namespace folk {
namespace {

constexpr std::array<double, 4> dilemma{3, 0, 5, 1};

using Joint = std::pair<State, State>;

/// Every joint state that some history of deviations reaches.
std::set<Joint> reached(const Automaton& a, const Automaton& b) {
  std::set<Joint> seen{{a.start(), b.start()}};
  std::vector<Joint> queue(seen.begin(), seen.end());
  while (!queue.empty()) {
    const auto [x, y] = queue.back();
    queue.pop_back();
    for (const Move own : {Move::C, Move::D})
      for (const Move theirs : {Move::C, Move::D}) {
        const Joint next{a.next(x, own, theirs), b.next(y, theirs, own)};
        if (seen.insert(next).second) queue.push_back(next);
      }
  }
  return seen;
}

/// What `a` earns against `b` from a joint state on.
double paid_from(const Automaton& a, const Automaton& b, const Joint& joint, const Criterion& criterion) {
  double sum = 0;
  double weight = test::round_weight(criterion);
  auto [x, y] = joint;
  for (int t = test::sweeps_of(criterion); t > 0; --t) {
    const Move own = move_of(a, x);
    const Move theirs = move_of(b, y);
    sum += weight * dilemma[Outcome{own, theirs}.index()];
    weight *= criterion.continuation();
    x = a.next(x, own, theirs);
    y = b.next(y, theirs, own);
  }
  return sum;
}

struct Gains {
  double once = 0;     ///< the largest from one deviation
  double replies = 0;  ///< the largest of a best reply
};

Gains gains_by_value_iteration(const Automaton& a, const Automaton& b, const Criterion& criterion) {
  const auto replies = test::reply_values(b, {}, criterion);
  Gains gains;
  for (const Joint& joint : reached(a, b)) {
    const auto [x, y] = joint;
    const double paid = paid_from(a, b, joint, criterion);
    const Move own = other(move_of(a, x));
    const Move theirs = move_of(b, y);
    const double after = paid_from(a, b, {a.next(x, own, theirs), b.next(y, theirs, own)}, criterion);
    gains.once = std::max(gains.once, test::round_weight(criterion) * dilemma[Outcome{own, theirs}.index()] +
                                          criterion.continuation() * after - paid);
    gains.replies = std::max(gains.replies, replies[y] - paid);
  }
  return gains;
}

/// Pairs of up to 8 states, small ones often, so that some are in equilibrium; gaps to 1e-9.
TEST(SubgamePerfectGap, HoldsTheOneShotDeviationPrincipleBothWaysIn10000RandomPairs) {
  RandomStream random({41, 0, 0, 0});
  constexpr std::array criteria{"discounted:0.2", "discounted:0.5", "discounted:0.7", "ending:0.5"};
  int perfect = 0;
  for (int i = 0; i < test::cases(10'000); ++i) {
    const std::uint32_t most = random() % 4 == 0 ? 8 : 2;
    const Automaton a = *tabulate(test::random_automaton(random, most, true), Sense::any_own_moves);
    const Automaton b = *tabulate(test::random_automaton(random, most, true), Sense::any_own_moves);
    const auto criterion = Criterion::parse(criteria[random() % criteria.size()]);
    const auto [first, second] = subgame_perfect_gaps(a, b, {{}, criterion});
    const Gains own = gains_by_value_iteration(a, b, criterion);
    const Gains theirs = gains_by_value_iteration(b, a, criterion);
    ASSERT_NEAR(first.gain, own.once, 1e-9) << i;
    ASSERT_NEAR(second.gain, theirs.once, 1e-9) << i;
    ASSERT_EQ(*first.exact == 0, own.replies <= 1e-9) << i;
    ASSERT_EQ(*second.exact == 0, theirs.replies <= 1e-9) << i;
    perfect += *first.exact == 0 && *second.exact == 0 ? 1 : 0;
  }
  EXPECT_GT(perfect, 100);
}

/// From a joint state with `left` rounds to go: the total of `a`, noting the largest one-shot gain on the way.
double by_all_histories(const Automaton& a, const Automaton& b, State x, State y, unsigned left, double& largest) {
  if (left == 0) return 0;
  const auto after = [&](Move own, Move theirs) {
    return dilemma[Outcome{own, theirs}.index()] +
           by_all_histories(a, b, a.next(x, own, theirs), b.next(y, theirs, own), left - 1, largest);
  };
  const Move own = move_of(a, x);
  const Move theirs = move_of(b, y);
  const double paid = after(own, theirs);
  largest = std::max(largest, after(other(own), theirs) - paid);
  after(own, other(theirs));
  after(other(own), other(theirs));
  return paid;
}

TEST(SubgamePerfectGap, OverUpTo5RoundsIsTheLargestOverAllHistoriesIn1000RandomPairs) {
  RandomStream random({42, 0, 0, 0});
  for (int i = 0; i < 1000; ++i) {
    const unsigned rounds = 1 + static_cast<unsigned>(random() % 5);
    const Automaton a = test::random_automaton(random, 5, true);
    const Automaton b = test::random_automaton(random, 5, true);
    const auto criterion = Criterion::finite(rounds);
    const auto [first, second] = subgame_perfect_gaps(unroll(a, Sense::any_own_moves, rounds),
                                                      unroll(b, Sense::any_own_moves, rounds), {{}, criterion});
    double own = 0;
    double theirs = 0;
    by_all_histories(a, b, a.start(), b.start(), rounds, own);
    by_all_histories(b, a, b.start(), a.start(), rounds, theirs);
    ASSERT_EQ(*first.exact, Rational(static_cast<std::int64_t>(own))) << i;
    ASSERT_EQ(*second.exact, Rational(static_cast<std::int64_t>(theirs))) << i;
  }
}

/// What the witness tells is replayed: after its history, its deviation gains what the gap says.
TEST(SubgamePerfectGap, IsWhatItsWitnessGainsIn1000RandomPairs) {
  RandomStream random({43, 0, 0, 0});
  const auto criterion = Criterion::discounted(0.7);
  for (int i = 0; i < 1000; ++i) {
    const Automaton a = test::random_automaton(random, 5, true);
    const Automaton b = test::random_automaton(random, 5, true);
    const Gap gap = subgame_perfect_gaps(a, b, {{}, criterion}).second;
    ASSERT_EQ(gap.gain > 0, gap.witness.deviation.has_value());
    if (!gap.witness.deviation) continue;
    State x = b.start();
    State y = a.start();
    const auto play = [&](Move own, Move theirs) {
      x = b.next(x, own, theirs);
      y = a.next(y, theirs, own);
    };
    for (const Outcome& round : gap.witness.history) play(round.own, round.theirs);
    const double before = paid_from(b, a, {x, y}, criterion);
    const Move theirs = move_of(a, y);
    const double now = criterion.stopping() * dilemma[Outcome{*gap.witness.deviation, theirs}.index()];
    play(*gap.witness.deviation, theirs);
    ASSERT_NEAR(now + criterion.continuation() * paid_from(b, a, {x, y}, criterion) - before, gap.gain, 1e-9);
  }
}

/// A state that is never reached and mixes sends pure pairs through the code for chance.
Automaton with_a_mixing_state(const Automaton& automaton) {
  auto nodes = automaton.nodes();
  nodes.push_back({0.5, {0, 0, 0, 0}});
  return Automaton(std::move(nodes), static_cast<std::uint32_t>(automaton.start()));
}

TEST(SubgamePerfectGap, OfChanceAgreesWithTheExactOneOn1000PurePairs) {
  RandomStream random({44, 0, 0, 0});
  constexpr std::array criteria{"discounted:0.3", "discounted:0.99", "ending:0.2", "mean", "finite:6"};
  for (int i = 0; i < 1000; ++i) {
    const Automaton a = test::random_automaton(random, 4, true);
    const Automaton b = test::random_automaton(random, 4, true);
    const auto criterion = Criterion::parse(criteria[random() % criteria.size()]);
    const auto exact = subgame_perfect_gaps(a, b, {{}, criterion});
    const auto rounded = subgame_perfect_gaps(with_a_mixing_state(a), b, {{}, criterion});
    ASSERT_FALSE(rounded.first.exact);
    ASSERT_NEAR(exact.first.gain, rounded.first.gain, rounded.first.residual) << criterion.to_string();
    ASSERT_NEAR(exact.second.gain, rounded.second.gain, rounded.second.residual) << criterion.to_string();
    ASSERT_LE(rounded.first.residual, 1e-8);
  }
}

TEST(SubgamePerfectGap, RefusesWhatItCannotSolve) {
  const Automaton all_c({{1, {0, 0, 0, 0}}}, 0);
  EXPECT_THROW(subgame_perfect_gaps(all_c, all_c, {{}, Criterion::finite(1'000'000'000)}), UsageError);
  EXPECT_THROW(
      subgame_perfect_gaps(all_c, all_c, {parse_payoffs("T=4503599627370497,R=3,P=1,S=0"), Criterion::finite(2)}),
      UsageError);
  const Automaton two({{1, {0, 1, 0, 1}}, {0, {0, 1, 0, 1}}}, 0);
  EXPECT_THROW(subgame_perfect_gaps(two, two, {{}, Criterion::mean()}, 2), UsageError);
}

}  // namespace
}  // namespace folk
