#include "made_play.h"
#include "strategies/named.h"

#include <folk/analysis/equilibria/self_confirming_gap.h>
#include <folk/analysis/judgement/match_judgement.h>
#include <folk/analysis/judgement/slip_posterior.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace folk {
namespace {

Candidates opponents(const std::string& spec) {
  return candidates_of(read_weighted_roster(Registry::standard(), spec, {}), 20);
}

/// The best of all plans, chance being weighed by hand.
double naive_best(const Machine& machine, double slip, unsigned rounds) {
  const auto payoffs = Payoffs{}.numbers();
  const std::function<double(State, unsigned)> best = [&](State state, unsigned left) {
    if (left == 0) return 0.0;
    const double c = slip + (1 - 2 * slip) * machine.cooperation(state);
    double most = -INFINITY;
    for (const Move own : {Move::C, Move::D}) {
      double value = 0;
      for (const Move theirs : {Move::C, Move::D}) {
        const double chance = theirs == Move::C ? c : 1 - c;
        if (chance > 0)
          value += chance * (payoffs[Outcome{own, theirs}.index()] + best(machine.next(state, theirs, own), left - 1));
      }
      most = std::max(most, value);
    }
    return most;
  };
  return best(machine.start(), rounds);
}

TEST(BestTotal, IsTheBestOfAllPlans) {
  for (const char* name : {"tit_for_tat", "pavlov", "spiteful", "gradual", "soft_majo", "gtft(0.3)"}) {
    const auto machine = test::named(name).machine;
    for (const double slip : {0.0, 0.05, 0.3})
      for (const unsigned rounds : {1U, 4U, 7U})
        EXPECT_NEAR(best_total(*machine, {}, rounds, slip).payoff, naive_best(*machine, slip, rounds), 1e-9) << name;
    EXPECT_EQ(best_total(*machine, {}, 5, 0).exact.has_value(), machine->deterministic());
  }
}

TEST(MatchJudgement, TellsWhomOneMayHaveMetAndWhatThatWouldHavePaid) {
  const std::vector matches{test::match_of("CCCC", "CCCC"), test::match_of("CDCC", "CCDC", "second"),
                            test::match_of("CCC", "DCD")};
  const auto roster = opponents("all_c,all_d,tit_for_tat,spiteful,gtft(0.5),memory(1,1)");
  const auto found = judge_matches(roster, matches, usual_slips(), {}, 2);
  ASSERT_EQ(found.size(), 3U);
  // Nobody defected: all_c pays 20 to who defects, tit_for_tat and spiteful 3 * 3 + 5.
  EXPECT_EQ(found[0].own_total, 12);
  ASSERT_EQ(found[0].consistent.size(), 4U);
  EXPECT_EQ(found[0].consistent[0].regret->exact, Rational(8));
  EXPECT_EQ(found[0].consistent[1].regret->exact, Rational(2));
  EXPECT_TRUE(found[0].consistent[1].certain);
  EXPECT_EQ(found[0].consistent[2].regret->exact, Rational(2));
  EXPECT_EQ(found[0].consistent_members[0], 8);  // the opening and CC are fixed, three of five genes free
  EXPECT_EQ(found[0].class_beliefs->gain, 2);
  EXPECT_EQ(found[0].class_beliefs->witness.belief, "tit_for_tat");
  // The last round alone: D pays 5 for 3. Earlier deviations are feared to cost more.
  EXPECT_EQ(found[0].free_beliefs.gain, 2);
  EXPECT_EQ(found[0].free_beliefs.witness.history.size(), 3U);
  EXPECT_EQ(found[1].name, "second");
  ASSERT_EQ(found[1].consistent.size(), 2U);  // tit_for_tat, and gtft may have done so
  EXPECT_FALSE(found[1].consistent[1].certain);
  EXPECT_FALSE(found[1].consistent[1].regret->exact);
  // Nobody plays DCD against CCC without a slip.
  EXPECT_TRUE(found[2].consistent.empty());
  EXPECT_FALSE(found[2].class_beliefs);
  ASSERT_TRUE(found[2].likeliest);
  EXPECT_GT(found[2].likeliest->slip, 0);
  const auto& likely = found[2].likeliest;
  if (likely->candidate < roster.behaviours.size()) {
    const auto& machine = *roster.behaviours[likely->candidate].first().machine;
    EXPECT_NEAR(likely->regret->best, naive_best(machine, likely->slip, 3), 1e-9);
    EXPECT_NEAR(likely->regret->regret, likely->regret->best - 3, 1e-9);
  }
}

TEST(MatchJudgement, GainsAreThoseOfTheSelfConfirmingNotions) {
  const auto roster = test::roster("classics");
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const auto& own = roster[seed % roster.size()];
    const auto& theirs = roster[(7 * seed + 3) % roster.size()];
    const std::vector matches{test::played(own, theirs, 5 + seed % 9, 0.2, seed)};
    const auto found = judge_matches(opponents("classics"), matches, {0, 0.1}, {}, 1).front();
    const auto& rounds = matches[0].rounds;
    const PlayPath path{{rounds.begin(), rounds.end()}, std::nullopt, false};
    ClassReplies replies(roster, {{}, Criterion::finite(rounds.size()), {}});
    const auto gap = class_gap(path, replies);
    ASSERT_TRUE(gap && found.class_beliefs);  // the opponent itself agrees
    EXPECT_EQ(found.class_beliefs->exact, gap->exact);
    EXPECT_LE(found.free_beliefs.gain, found.class_beliefs->gain);
    EXPECT_TRUE(std::any_of(found.consistent.begin(), found.consistent.end(), [&](const auto& one) {
      return opponents("classics").behaviours[one.behaviour].first().name == theirs.name;
    }));
  }
}

TEST(MatchJudgement, CountsBeliefsThatWereRight) {
  std::vector matches{test::match_of("CC", "CD")};
  matches[0].rounds[0].belief = 0.9;
  matches[0].rounds[1].belief = 0.5;  // even odds hold C likelier
  const auto found = judge_matches(opponents("classics"), matches, {0}, {}, 1).front();
  EXPECT_EQ(found.stated, 2U);
  EXPECT_EQ(found.right, 1U);
}

}  // namespace
}  // namespace folk
