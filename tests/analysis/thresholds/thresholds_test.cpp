#include "analysis/play/naive.h"
#include "cases.h"
#include "games/ended_work.h"
#include "games/expect_error.h"

#include <folk/analysis/equilibria/equilibrium_check.h>
#include <folk/analysis/thresholds/thresholds.h>
#include <folk/strategies/machine_text.h>
#include <folk/strategies/registry.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace folk {
namespace {

/// One-shot and best-reply gains in doubles, by nothing but repeated substitution: the definitions, slowly.
class SlowGains {
public:
  SlowGains(const Automaton& first, const Automaton& second, const Payoffs& payoffs, double d)
      : machines_{&first, &second},
        payoff_(payoffs.numbers()),
        d_(d),
        columns_(second.size()) {
    solve_plans();
  }

  /// Payoffs are times 1 - d.
  double self_confirming(Seat side) const {
    double gain = 0;
    std::size_t s = start();
    for (std::size_t t = 0; t <= next_.size(); ++t, s = next_[s]) gain = std::max(gain, punished_gain(side, s));
    return gain;
  }

  double subgame_perfect(Seat side) const {
    double gain = 0;
    std::vector<bool> seen(next_.size());
    std::vector<std::size_t> open{start()};
    seen[start()] = true;
    while (!open.empty()) {
      const std::size_t s = open.back();
      open.pop_back();
      gain = std::max(gain, one_shot_gain(side, s));
      for (const Outcome outcome : all_outcomes)
        if (const std::size_t next = after(s, outcome); !seen[next]) {
          seen[next] = true;
          open.push_back(next);
        }
    }
    return gain;
  }

  double nash(Seat side) const {
    const Automaton& opponent = *machines_[side == Seat::first ? 1 : 0];
    std::vector<double> value(opponent.size(), 0.0);
    for (double left = 1; left > 1e-12; left *= d_)
      for (std::size_t y = 0; y < value.size(); ++y) {
        const Move theirs = move_of(opponent, y);
        double best = -1e9;
        for (const Move own : {Move::C, Move::D})
          best = std::max(best,
                          (1 - d_) * payoff_[Outcome{own, theirs}.index()] + d_ * value[opponent.next(y, theirs, own)]);
        value[y] = best;
      }
    return value[opponent.start()] - worth(side, start());
  }

  /// Of one deviation from the plans after this history.
  double gain_of(const Binding& binding) const {
    std::size_t s = start();
    for (const Outcome& round : binding.history) s = after(s, round);
    EXPECT_NE(own_move(binding.side, s), binding.deviation);
    if (binding.then == Binding::Then::minmax) return punished_gain(binding.side, s);
    if (binding.then == Binding::Then::plan) return one_shot_gain(binding.side, s);
    return nash(binding.side);
  }

private:
  std::size_t start() const { return machines_[0]->start() * columns_ + machines_[1]->start(); }

  Outcome planned(std::size_t s) const {
    return {move_of(*machines_[0], s / columns_), move_of(*machines_[1], s % columns_)};
  }

  Move own_move(Seat side, std::size_t s) const { return side == Seat::first ? planned(s).own : planned(s).theirs; }

  std::size_t after(std::size_t s, Outcome outcome) const {
    const auto [a, b] = outcome;
    return machines_[0]->next(s / columns_, a, b) * columns_ + machines_[1]->next(s % columns_, b, a);
  }

  double payoff(Seat side, Outcome outcome) const {
    return payoff_[(side == Seat::first ? outcome : outcome.exchanged()).index()];
  }

  double worth(Seat side, std::size_t s) const { return worth_[side == Seat::first ? 0 : 1][s]; }

  /// All states at once, whether some history reaches them or not; the number of rounds doubles each time.
  void solve_plans() {
    const std::size_t n = machines_[0]->size() * columns_;
    for (std::size_t s = 0; s < n; ++s) next_.push_back(after(s, planned(s)));
    for (const Seat side : both_seats) {
      std::vector<double>& value = worth_[side == Seat::first ? 0 : 1];
      for (std::size_t s = 0; s < n; ++s) value.push_back((1 - d_) * payoff(side, planned(s)));
    }
    std::vector<std::size_t> jump = next_;
    for (double weight = d_; weight > 1e-14; weight *= weight) {
      for (auto& value : worth_) {
        std::vector<double> longer(n);
        for (std::size_t s = 0; s < n; ++s) longer[s] = value[s] + weight * value[jump[s]];
        value = std::move(longer);
      }
      std::vector<std::size_t> further(n);
      for (std::size_t s = 0; s < n; ++s) further[s] = jump[jump[s]];
      jump = std::move(further);
    }
  }

  static Outcome deviated(Seat side, Outcome outcome) {
    return side == Seat::first ? Outcome{other(outcome.own), outcome.theirs}
                               : Outcome{outcome.own, other(outcome.theirs)};
  }

  double one_shot_gain(Seat side, std::size_t s) const {
    const Outcome o = deviated(side, planned(s));
    return (1 - d_) * payoff(side, o) + d_ * worth(side, after(s, o)) - worth(side, s);
  }

  double punished_gain(Seat side, std::size_t s) const {
    const Outcome o = deviated(side, planned(s));
    return (1 - d_) * payoff(side, o) + d_ * mixed_minmax() - worth(side, s);
  }

  /// Their mixture that makes the better of two moves worst: pure, or one that makes both equal.
  double mixed_minmax() const {
    const auto best = [&](double q) {
      return std::max(q * payoff_[0] + (1 - q) * payoff_[1], q * payoff_[2] + (1 - q) * payoff_[3]);
    };
    double least = std::min(best(0), best(1));
    const double slope = payoff_[0] - payoff_[1] - payoff_[2] + payoff_[3];
    const double q = slope == 0 ? -1 : (payoff_[3] - payoff_[1]) / slope;
    if (q > 0 && q < 1) least = std::min(least, best(q));
    return least;
  }

  std::array<const Automaton*, 2> machines_;
  std::array<double, 4> payoff_;
  double d_;
  std::size_t columns_;
  std::vector<std::size_t> next_;
  std::array<std::vector<double>, 2> worth_;
};

Automaton machine(const std::string& name) {
  return *tabulate(*Registry::standard().make(name).machine, Sense::any_own_moves);
}

std::string plays(const Binding& binding) {
  std::string text;
  for (const Outcome& round : binding.history) text += {to_char(round.own), to_char(round.theirs), ' '};
  return text + (binding.side == Seat::first ? "first " : "second ") + to_char(binding.deviation);
}

struct Texts {
  std::string nash;
  std::string subgame_perfect;
  std::string self_confirming;

  bool operator==(const Texts&) const = default;
  friend std::ostream& operator<<(std::ostream& out, const Texts& texts) {
    return out << texts.nash << " | " << texts.subgame_perfect << " | " << texts.self_confirming;
  }
};

Texts texts(const Thresholds& found) {
  return {to_text(found.nash->set), to_text(found.subgame_perfect->set),
          to_text(found.self_confirming_unrestricted->set)};
}

Texts against_itself(const std::string& name, const Payoffs& payoffs = {}) {
  return texts(thresholds(machine(name), machine(name), payoffs));
}

TEST(Thresholds, OfTheKnownMachinesAgainstThemselves) {
  EXPECT_EQ(against_itself("spiteful"), (Texts{"[1/2, 1)", "[1/2, 1)", "[1/2, 1)"}));
  EXPECT_EQ(against_itself("tit_for_tat"), (Texts{"[2/3, 1)", "never", "[1/2, 1)"}));
  EXPECT_EQ(against_itself("pavlov"), (Texts{"never", "never", "[1/2, 1)"}));
  EXPECT_EQ(against_itself("all_d"), (Texts{"(0, 1)", "(0, 1)", "(0, 1)"}));
  EXPECT_EQ(against_itself("grudger"), (Texts{"[1/2, 1)", "never", "[1/2, 1)"}));
  EXPECT_EQ(against_itself("all_c"), (Texts{"never", "never", "[1/2, 1)"}));
  EXPECT_EQ(against_itself("mistrust"), (Texts{"(0, 1/4]", "never", "(0, 1)"}));
}

TEST(Thresholds, PavlovIsSubgamePerfectWhereTemptationIsSmall) {
  Payoffs payoffs;
  payoffs.temptation = 4;
  EXPECT_EQ(against_itself("pavlov", payoffs).subgame_perfect, "[1/2, 1)");
  payoffs.temptation = parse_rational("4.5");  // (1 - d) T + d P <= R from 3/7 on, and Nash from T - R <= d (R - P)
  EXPECT_EQ(against_itself("pavlov", payoffs), (Texts{"[3/4, 1)", "[3/4, 1)", "[3/7, 1)"}));
}

TEST(Thresholds, IrrationalEndsAreNamed) {
  EXPECT_EQ(texts(thresholds(machine("tit_for_tat"), machine("hard_tft"), {})).nash,
            "[root of 3 d^2 - 2 in (0.81, 0.82), 1)");
  EXPECT_EQ(against_itself("per_cd").self_confirming, "[root of 2 d^2 - 1 in (0.70, 0.71), 1)");
}

TEST(Thresholds, TheDeviationThatBindsIsNamed) {
  const Thresholds found = thresholds(machine("tit_for_tat"), machine("mistrust"), {});
  // The moves alternate: C meets D, then D meets C.
  ASSERT_EQ(to_text(found.nash->set), "[1/4, 2/3]");
  const auto& part = found.nash->set.intervals()[0];
  EXPECT_EQ(plays(found.nash->bindings[part.low.constraint]), "first D");
  EXPECT_EQ(found.nash->bindings[part.low.constraint].then, Binding::Then::best_reply);
  const Thresholds one_side = thresholds(machine("tit_for_tat"), machine("mistrust"), {}, Sides::second);
  ASSERT_EQ(to_text(one_side.self_confirming_unrestricted->set), "[1/4, 1)");
  EXPECT_EQ(plays(one_side.self_confirming_unrestricted->bindings[0]), "CD second D");
}

TEST(Thresholds, OneSideAloneMayHoldWhereBothDoNot) {
  const Automaton all_d = machine("all_d");
  const Automaton all_c = machine("all_c");
  EXPECT_EQ(texts(thresholds(all_d, all_c, {}, Sides::first)).subgame_perfect, "(0, 1)");
  EXPECT_EQ(texts(thresholds(all_d, all_c, {}, Sides::second)), (Texts{"never", "never", "never"}));
  EXPECT_EQ(texts(thresholds(all_d, all_c, {})), (Texts{"never", "never", "never"}));
}

TEST(Thresholds, APointAloneIsKept) {
  // With T = R and P = S a machine's own moves pay it nothing by themselves.
  Payoffs payoffs;
  payoffs.temptation = 3;
  payoffs.sucker = 1;
  EXPECT_EQ(against_itself("all_c", payoffs), (Texts{"(0, 1)", "(0, 1)", "(0, 1)"}));
  // tit_for_tat wants d >= (T - R) / (R - S) for C for ever, and d <= (T - R) / (P - S) for no end of turns: at
  // T + S = R + P both are the same point, which is where mistrust and it are in equilibrium.
  payoffs.temptation = 4;
  payoffs.sucker = 0;
  const Thresholds found = thresholds(machine("tit_for_tat"), machine("mistrust"), payoffs);
  EXPECT_EQ(to_text(found.nash->set), "{1/3}");
  ASSERT_EQ(found.nash->bindings.size(), 2U);
}

TEST(Thresholds, WhatCannotBeComputedIsRefusedOrMissing) {
  const Automaton mixing({{0.5, {0, 0, 0, 0}}}, 0);
  test::expect_error<UsageError>([&] { thresholds(machine("all_d"), mixing, {}); }, "mixes");
  const Automaton cut = unroll(machine("per_ccd"), Sense::any_own_moves, 2);
  test::expect_error<UsageError>([&] { thresholds(cut, machine("all_d"), {}); }, "unrolled");
  ThresholdLimits limits;
  limits.joint_states = 1;
  const Thresholds found = thresholds(machine("spiteful"), machine("spiteful"), {}, Sides::both, limits);
  EXPECT_FALSE(found.subgame_perfect);
  EXPECT_TRUE(found.nash && found.self_confirming_unrestricted);
  // Nash never, so subgame perfect never.
  const Thresholds settled = thresholds(machine("pavlov"), machine("pavlov"), {}, Sides::both, limits);
  EXPECT_EQ(texts(settled).subgame_perfect, "never");
  limits.terms = 2;
  EXPECT_FALSE(thresholds(machine("per_ccd"), machine("tf2t"), {}, Sides::both, limits).nash);
}

/// C until a move is not the machine's or theirs not the same; then `rounds` rounds of D, anew after each such move.
Automaton forgiving_trigger(std::uint32_t rounds) {
  std::vector<Automaton::Node> nodes{{1, {0, 1, 1, 1}}};
  for (std::uint32_t i = 1; i <= rounds; ++i) nodes.push_back({0, {1, 1, 1, i == rounds ? 0 : i + 1}});
  return Automaton(std::move(nodes), 0);
}

TEST(Thresholds, LongerPunishmentNeedsLessPatience) {
  // T - R <= (R - P)(d + ... + d^n), and in the punishment nobody gains: for n = 1 from d = 1, for n = 2 from the
  // golden ratio less one.
  EXPECT_EQ(texts(thresholds(forgiving_trigger(1), forgiving_trigger(1), {})).subgame_perfect, "never");
  EXPECT_EQ(texts(thresholds(forgiving_trigger(2), forgiving_trigger(2), {})).subgame_perfect,
            "[root of d^2 + d - 1 in (0.61, 0.62), 1)");
  double last = 1;
  for (const std::uint32_t rounds : {3U, 5U, 10U, 40U}) {
    const Thresholds found = thresholds(forgiving_trigger(rounds), forgiving_trigger(rounds), {});
    EXPECT_EQ(found.nash->set, found.subgame_perfect->set);
    const double from = to_numbers(found.subgame_perfect->set).at(0)[0];
    EXPECT_LT(from, last);
    EXPECT_GE(from, 0.5);
    last = from;
  }
}

/// A pair of machines of 1 to `most` states, often a machine and itself, and a dilemma or any symmetric game.
struct Case {
  Automaton first;
  Automaton second;
  Payoffs payoffs;
};

Case random_case(RandomStream& random, std::uint32_t most) {
  Automaton first = test::random_automaton(random, most, true);
  Automaton second = random.chance(0.5) ? first : test::random_automaton(random, most, true);
  Payoffs payoffs;
  if (random.chance(0.3)) payoffs.temptation = 4;
  if (random.chance(0.3)) {
    const auto draw = [&] {
      const auto above = static_cast<int>(random() % 7) - 1;  // each draw a statement: compilers differ in their order
      return Rational(above, 1 + static_cast<int>(random() % 2));
    };
    payoffs = {draw(), draw(), draw(), draw()};
  }
  return {std::move(first), std::move(second), payoffs};
}

/// Forty discount factors from 1/45 to 39/45, and one of more patience.
Rational scanned(std::uint64_t i) {
  return i % 40 == 39 ? Rational(19, 20) : Rational(static_cast<int>(i % 40) + 1, 45);
}

/// Whether one of two gains is above rounding, which leaves gains of nothing below 1e-9.
bool gains(double first, double second) { return std::max(first, second) > 1e-9; }

// A true gain below 1e-9 is rare, but there are such: by what comes six rounds later at d = 1/45. Where rounding may
// hide one, the exact gap decides.
void check_scan(const Case& pair, const Thresholds& found, const Rational& d) {
  const SlowGains slow(pair.first, pair.second, pair.payoffs, to_double(d));
  std::optional<PairGaps> exact;
  const auto check = [&](const Threshold& threshold, double first, double second, std::optional<Gap> SideGaps::*gap) {
    const bool holds = threshold.set.contains(d);
    if (holds == !gains(first, second)) return;
    if (!exact) exact = pair_gaps(pair.first, pair.second, {{pair.payoffs, Criterion::discounted(d)}, {}});
    EXPECT_FALSE(gains(first, second));  // a set may be less than rounding says, never more
    EXPECT_EQ(holds, *((exact->first.*gap)->exact) == 0 && *((exact->second.*gap)->exact) == 0);
  };
  check(*found.nash, slow.nash(Seat::first), slow.nash(Seat::second), &SideGaps::nash);
  check(*found.subgame_perfect, slow.subgame_perfect(Seat::first), slow.subgame_perfect(Seat::second),
        &SideGaps::subgame_perfect);
  check(*found.self_confirming_unrestricted, slow.self_confirming(Seat::first), slow.self_confirming(Seat::second),
        &SideGaps::self_confirming_unrestricted);
}

bool is_subset(const Threshold& part, const Threshold& whole) {
  DiscountSet both = part.set;
  return !both.intersect(whole.set);
}

/// At each end its deviation gains nothing, to rounding; returns how many ends there were.
std::size_t check_ends(const Case& pair, const Threshold& threshold) {
  std::size_t ends = 0;
  for (const auto& interval : threshold.set.intervals())
    for (const DiscountSet::End& end : {interval.low, interval.high}) {
      if (end.constraint == DiscountSet::no_constraint) continue;
      ++ends;
      const SlowGains slow(pair.first, pair.second, pair.payoffs, end.at.nearest());
      EXPECT_NEAR(slow.gain_of(threshold.bindings.at(end.constraint)), 0, 1e-9);
    }
  return ends;
}

TEST(Thresholds, TenThousandPairsAreNestedAndAgreeWithScans) {
  RandomStream random({20261122, 3, 0, 0});
  std::size_t ends = 0;
  for (std::uint64_t i = 0; i < test::cases<std::uint64_t>(10'000) && !HasFailure(); ++i) {
    const Case pair = random_case(random, i % 2 == 0 ? 8 : 3);
    const Thresholds found = thresholds(pair.first, pair.second, pair.payoffs);
    EXPECT_TRUE(is_subset(*found.subgame_perfect, *found.nash));
    EXPECT_TRUE(is_subset(*found.nash, *found.self_confirming_unrestricted));
    // Each fortieth pair at all forty discount factors, the others at four of them.
    for (std::uint64_t k = 0; k < (i % 40 == 0 ? 40U : 4U); ++k) check_scan(pair, found, scanned(i + 11 * k));
    for (const auto* threshold : {&found.nash, &found.subgame_perfect, &found.self_confirming_unrestricted})
      ends += check_ends(pair, **threshold);
    EXPECT_FALSE(HasFailure()) << "pair " << i << ":\n"
                               << write_machine("first", pair.first) << write_machine("second", pair.second)
                               << to_text(pair.payoffs) << ": " << texts(found);
  }
  EXPECT_GT(ends, test::cases<std::size_t>(4'000));  // the cases are not all "always" and "never"
}

bool same(const Thresholds& one, const Thresholds& two) {
  return one.nash->set == two.nash->set && one.subgame_perfect->set == two.subgame_perfect->set &&
         one.self_confirming_unrestricted->set == two.self_confirming_unrestricted->set;
}

RC_GTEST_PROP(Thresholds, SidesExchangedAreTheSame, ()) {
  RandomStream random({*rc::gen::arbitrary<std::uint64_t>(), 4, 0, 0});
  const Case pair = random_case(random, 8);
  const auto one = [&](Sides sides) { return thresholds(pair.first, pair.second, pair.payoffs, sides); };
  const auto two = [&](Sides sides) { return thresholds(pair.second, pair.first, pair.payoffs, sides); };
  RC_ASSERT(same(one(Sides::both), two(Sides::both)));
  RC_ASSERT(same(one(Sides::first), two(Sides::second)));
  RC_ASSERT(same(one(Sides::second), two(Sides::first)));
  Thresholds first = one(Sides::first);
  const Thresholds second = one(Sides::second);
  first.nash->set.intersect(second.nash->set);
  first.subgame_perfect->set.intersect(second.subgame_perfect->set);
  first.self_confirming_unrestricted->set.intersect(second.self_confirming_unrestricted->set);
  RC_ASSERT(same(first, one(Sides::both)));
}

TEST(Thresholds, EndAsTheirProgressWishes) {
  const auto machine = [](const char* name) {
    return minimise(*tabulate(*Registry::standard().make(name).machine, Sense::any_own_moves), Sense::any_own_moves);
  };
  const auto first = machine("pavlov");
  const auto second = machine("spiteful");
  test::expect_ends([&](const Progress& progress) {
    EXPECT_TRUE(thresholds(first, second, {}, Sides::both, {}, progress).subgame_perfect);
  });
}

}  // namespace
}  // namespace folk
