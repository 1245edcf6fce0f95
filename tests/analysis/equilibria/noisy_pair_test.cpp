// Pairs under noise: the gaps against sums over all that can happen, which share nothing with the solvers.

#include "analysis/play/naive.h"
#include "analysis/replies/value_iteration.h"
#include "cases.h"
#include "games/expect_error.h"
#include "strategies/named.h"

#include <folk/analysis/equilibria/equilibrium_check.h>
#include <folk/analysis/equilibria/examination.h>
#include <folk/analysis/equilibria/subgame_perfect_gap.h>
#include <folk/analysis/play/markov_play.h>
#include <folk/games/error.h>
#include <folk/strategies/registry.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>

namespace folk {
namespace {

using test::named;
using Joint = std::pair<State, State>;

constexpr std::array<double, 4> paid_by_outcome{3, 0, 5, 1};
constexpr std::array noises{0.01, 0.2, 0.5, 0.9};

/// Each outcome with its probability when these P(C) are meant, and then what follows.
template <class Follow>
double expected_by_outcome(double own, double theirs, double noise, const Follow& follow) {
  const double p = own * (1 - noise) + (1 - own) * noise;
  const double q = theirs * (1 - noise) + (1 - theirs) * noise;
  double sum = 0;
  for (const Outcome outcome : all_outcomes)
    sum += (outcome.own == Move::C ? p : 1 - p) * (outcome.theirs == Move::C ? q : 1 - q) * follow(outcome);
  return sum;
}

Joint joint_after(const Automaton& a, const Automaton& b, const Joint& joint, Outcome outcome) {
  return {a.next(joint.first, outcome.own, outcome.theirs), b.next(joint.second, outcome.theirs, outcome.own)};
}

/// What `a` earns from every joint state on that some history reaches, by value iteration.
std::map<Joint, double> values_by_iteration(const Automaton& a, const Automaton& b, double noise,
                                            const Criterion& criterion) {
  std::map<Joint, double> values{{{a.start(), b.start()}, 0}};
  for (std::size_t known = 0; known != values.size();) {
    known = values.size();
    for (const auto& [joint, value] : std::map(values))
      for (const Outcome outcome : all_outcomes) values.emplace(joint_after(a, b, joint, outcome), 0);
  }
  for (int sweep = test::sweeps_of(criterion); sweep > 0; --sweep) {
    const std::map<Joint, double> before = values;
    for (auto& [joint, value] : values)
      value = expected_by_outcome(a.cooperation(joint.first), b.cooperation(joint.second), noise,
                                  [&, at = joint](Outcome outcome) {
                                    return test::round_weight(criterion) * paid_by_outcome[outcome.index()] +
                                           criterion.continuation() * before.at(joint_after(a, b, at, outcome));
                                  });
  }
  return values;
}

TEST(NoisyPair, WithoutEndItsGapsAreThoseOfValueIterationIn400RandomPairs) {
  RandomStream random({61, 0, 0, 0});
  constexpr std::array criteria{"discounted:0.3", "discounted:0.8", "ending:0.3"};
  int equilibria = 0;
  for (int i = 0; i < test::cases(400); ++i) {
    const std::uint32_t most = random() % 4 == 0 ? 4 : 2;
    const Automaton a = test::random_automaton(random, most, random() % 3 != 0);
    const Automaton b = test::random_automaton(random, most, random() % 3 != 0);
    const double noise = noises[random() % noises.size()];
    const auto criterion = Criterion::parse(criteria[random() % criteria.size()]);
    const auto values = values_by_iteration(a, b, noise, criterion);
    const auto replies = test::reply_values(b, {}, criterion, noise);
    double once = 0;
    for (const auto& [joint, value] : values)
      for (const double meant : {0.0, 1.0})
        once = std::max(
            once, expected_by_outcome(meant, b.cooperation(joint.second), noise, [&, at = joint](Outcome outcome) {
                    return test::round_weight(criterion) * paid_by_outcome[outcome.index()] +
                           criterion.continuation() * values.at(joint_after(a, b, at, outcome));
                  }) - value);
    const SideGaps gaps = pair_gaps(a, b, {{{}, criterion, noise}, {{"truth", named("all_c").machine, {}}}}).first;
    ASSERT_NEAR(gaps.nash->gain, replies[b.start()] - values.at({a.start(), b.start()}), 1e-8) << i;
    ASSERT_NEAR(gaps.subgame_perfect->gain, once, 1e-8) << i;
    // Every history comes about, so that Nash and perfect are one; by how much is not.
    ASSERT_EQ(gaps.nash->gain == 0, gaps.subgame_perfect->gain == 0) << i << " " << once;
    equilibria += gaps.nash->gain == 0 ? 1 : 0;
  }
  EXPECT_GT(equilibria, test::cases(400) / 20);
}

/// Bit s of a number says what a stationary reply means to play when the opponent is in state s.
Automaton stationary(const Automaton& opponent, std::size_t number) {
  std::vector<Automaton::Node> nodes;
  for (std::size_t s = 0; s < opponent.size(); ++s) {
    const auto& next = opponent.nodes()[s].next;
    nodes.push_back({(number >> s & 1U) == 0 ? 1.0 : 0.0, {next[0], next[2], next[1], next[3]}});
  }
  return Automaton(std::move(nodes), static_cast<std::uint32_t>(opponent.start()));
}

double mean_of(const Automaton& own, const Automaton& theirs, double noise) {
  const auto pair = play_markov(own, theirs, noise, Criterion::mean());
  double sum = 0;
  for (std::size_t o = 0; o < 4; ++o) sum += pair->weights[o] * paid_by_outcome[o];
  return sum;
}

TEST(NoisyPair, UnderTheMeanTheBestOfAllStationaryRepliesGainsItsNashGapIn400RandomPairs) {
  RandomStream random({62, 0, 0, 0});
  for (int i = 0; i < test::cases(400); ++i) {
    const Automaton a = test::random_automaton(random, 4, random() % 2 == 0);
    const Automaton b = test::random_automaton(random, 4, random() % 2 == 0);
    const double noise = noises[random() % noises.size()];
    double best = 0;
    for (std::size_t number = 0; number < std::size_t{1} << b.size(); ++number)
      best = std::max(best, mean_of(stationary(b, number), b, noise));
    const SideGaps gaps = pair_gaps(a, b, {{{}, Criterion::mean(), noise}, {}}).first;
    ASSERT_NEAR(gaps.nash->gain, std::max(0.0, best - mean_of(a, b, noise)), 1e-8) << i;
    ASSERT_GE(gaps.subgame_perfect->gain, gaps.nash->gain - 1e-8) << i;
  }
}

/// From a joint state with `left` rounds to go: what `a` earns as it is and with a best reply, and the largest gain of
/// one deviation anywhere on the way.
struct Course {
  double paid = 0;
  double best = 0;
};
Course by_all_histories(const Automaton& a, const Automaton& b, const Joint& joint, unsigned left, double noise,
                        double& once) {
  if (left == 0) return {};
  std::array<Course, 4> after;
  for (const Outcome outcome : all_outcomes)
    after[outcome.index()] = by_all_histories(a, b, joint_after(a, b, joint, outcome), left - 1, noise, once);
  const auto worth = [&](double meant, double Course::*member) {
    return expected_by_outcome(meant, b.cooperation(joint.second), noise, [&](Outcome outcome) {
      return paid_by_outcome[outcome.index()] + after[outcome.index()].*member;
    });
  };
  const Course here{worth(a.cooperation(joint.first), &Course::paid),
                    std::max(worth(0, &Course::best), worth(1, &Course::best))};
  once = std::max({once, worth(0, &Course::paid) - here.paid, worth(1, &Course::paid) - here.paid});
  return here;
}

TEST(NoisyPair, OverUpTo4RoundsItsGapsAreThoseOfAllHistoriesIn400RandomPairs) {
  RandomStream random({63, 0, 0, 0});
  for (int i = 0; i < test::cases(400); ++i) {
    const unsigned rounds = 1 + static_cast<unsigned>(random() % 4);
    const Automaton a = test::random_automaton(random, 4, random() % 2 == 0);
    const Automaton b = test::random_automaton(random, 4, random() % 2 == 0);
    const double noise = noises[random() % noises.size()];
    double once = 0;
    const Course course = by_all_histories(a, b, {a.start(), b.start()}, rounds, noise, once);
    const SideGaps gaps = pair_gaps(a, b, {{{}, Criterion::finite(rounds), noise}, {}}).first;
    ASSERT_NEAR(gaps.nash->gain, course.best - course.paid, 1e-9) << i;
    ASSERT_NEAR(gaps.subgame_perfect->gain, once, 1e-9) << i;
  }
}

TEST(NoisyPair, WithLittleNoiseItsDiscountedGapsAreNearThoseWithoutIn200RandomPairs) {
  RandomStream random({64, 0, 0, 0});
  for (int i = 0; i < test::cases(200); ++i) {
    const Automaton a = test::random_automaton(random, 5, true);
    const Automaton b = test::random_automaton(random, 5, true);
    const auto gaps = [&](Noise noise) { return pair_gaps(a, b, {{{}, Criterion::discounted(0.8), noise}, {}}).first; };
    const SideGaps still = gaps(0);
    const SideGaps noisy = gaps(1e-9);
    ASSERT_NEAR(still.nash->gain, noisy.nash->gain, 1e-6) << i;
    ASSERT_NEAR(still.subgame_perfect->gain, noisy.subgame_perfect->gain, 1e-6) << i;
    ASSERT_TRUE(still.nash->exact);
  }
}

PairGaps against_itself(const char* name, const char* criterion, double noise, const char* payoffs) {
  const auto machine = named(name).machine;
  return pair_gaps(*machine, *machine,
                   {{parse_payoffs(payoffs), Criterion::parse(criterion), noise}, test::roster("classics")});
}

TEST(NoisyPair, PavlovIsAnEquilibriumWhere2RExceedsTAndPAndTitForTatIsNot) {
  for (const char* criterion : {"discounted:0.8", "discounted:0.99", "mean"}) {
    const PairGaps pavlov = against_itself("pavlov", criterion, 0.01, "T=4,R=3,P=1,S=0");
    EXPECT_EQ(pavlov.first.nash->gain, 0) << criterion;
    EXPECT_EQ(pavlov.first.subgame_perfect->gain, 0) << criterion;
    EXPECT_EQ(pavlov.first.self_confirming_unrestricted->gain, 0) << criterion;
    // Each of its moves is strictly best, which doubles can prove; not so that of all replies none has a better mean.
    const bool proved = pavlov.first.nash->exact && pavlov.second.subgame_perfect->exact;
    EXPECT_EQ(proved, criterion != std::string("mean"));
    EXPECT_EQ(pavlov.second.self_confirming_class->witness.belief, "pavlov") << criterion;
    const PairGaps tit_for_tat = against_itself("tit_for_tat", criterion, 0.01, "T=4,R=3,P=1,S=0");
    EXPECT_GT(tit_for_tat.first.nash->gain, 0.01) << criterion;
    EXPECT_GT(tit_for_tat.first.subgame_perfect->gain, 0.01) << criterion;
    EXPECT_GT(tit_for_tat.first.self_confirming_unrestricted->gain, 0.01) << criterion;
  }
  // With 2R = T + P a deviation costs in the round of the punishment only what it brought, and that is discounted.
  EXPECT_GT(against_itself("pavlov", "discounted:0.99", 0.01, "T=5,R=3,P=1,S=0").first.subgame_perfect->gain, 0);
  for (const char* criterion : {"finite:7", "discounted:0.9", "mean", "ending:0.1"}) {
    const PairGaps all_d = against_itself("all_d", criterion, 0.3, "T=5,R=3,P=1,S=0");
    EXPECT_EQ(all_d.first.nash->gain, 0) << criterion;
    EXPECT_EQ(all_d.first.subgame_perfect->gain, 0) << criterion;
    EXPECT_EQ(all_d.second.self_confirming_class->exact.has_value(), criterion != std::string("mean"));
  }
}

/// Two tit_for_tat earn 9/4 a round however rare slips are, and all_c earns almost 3 against one.
TEST(NoisyPair, NoiseThatADoubleNextToOneCannotHoldCountsUnderTheMean) {
  for (const double noise : {1e-6, 1e-12, 1e-18}) {
    const Gap gap = *against_itself("tit_for_tat", "mean", noise, "T=5,R=3,P=1,S=0").first.nash;
    EXPECT_NEAR(gap.gain, 0.75, 1e-4) << noise;
  }
}

TEST(NoisyPair, AMemberOfTheClassAgreesWhenItAnswersAlikeAfterEveryHistory) {
  const auto belief = [](const char* theirs, const char* members, const char* criterion, double noise) {
    const EquilibriumQuestion question{{{}, Criterion::parse(criterion), noise}, test::roster(members)};
    return pair_gaps(*named("all_c").machine, *named(theirs).machine, question).first.self_confirming_class;
  };
  // Alike as long as no move of its own slips.
  EXPECT_FALSE(belief("spiteful", "grudger,tit_for_tat", "discounted:0.9", 0.1));
  EXPECT_EQ(belief("spiteful", "grudger,spiteful", "discounted:0.9", 0.1)->witness.belief, "spiteful");
  // What differs in round 3 alone is the same over two rounds.
  EXPECT_EQ(belief("tf2t", "gradual,all_c", "finite:2", 0.1)->witness.belief, "all_c");
  EXPECT_FALSE(belief("tf2t", "gradual,all_c", "finite:3", 0.1));
  // At one half every move is a coin's, whoever plays.
  EXPECT_EQ(belief("spiteful", "all_d", "mean", 0.5)->witness.belief, "all_d");
}

TEST(NoisyPair, WhatCannotBeSaidIsRefusedBeforeAnyWork) {
  ExaminationQuestion question;
  question.policy = named("pavlov");
  question.opponents = {named("tit_for_tat"), {"opaque", nullptr, {}}};
  question.noise = 0.1;
  test::expect_error<UsageError>([&] { examine(question); }, "opaque is played, not enumerated");
  question.opponents.pop_back();
  question.noise = 1;
  test::expect_error<UsageError>([&] { examine(question); }, "noise 1");
  EXPECT_THROW(pair_gaps(*named("all_c").machine, *named("all_c").machine, {{{}, Criterion::mean(), 1}, {}}),
               UsageError);
  question.noise = 0.1;
  question.criterion = Criterion::discounted(0.9);
  question.opponents = {named("gradual")};
  question.horizon = 20;
  test::expect_error<UsageError>([&] { examine(question); }, "a pair that slips");
}

TEST(NoisyPair, ItIsListedByItsSituationsAndHasNoThresholds) {
  ExaminationQuestion question;
  question.policy = named("tit_for_tat");
  question.opponents = {question.policy};
  question.criterion = Criterion::discounted(0.9);
  question.noise = 0.1;
  const PairExamination pair = examine(question).pairs.front();
  EXPECT_FALSE(pair.path);
  EXPECT_FALSE(pair.thresholds);
  EXPECT_EQ(pair.method, Method::markov);
  ASSERT_EQ(pair.all_states, 4U);
  EXPECT_NEAR(pair.states.front().own, 0.9, 1e-15);
}

}  // namespace
}  // namespace folk
