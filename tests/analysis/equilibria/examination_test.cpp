#include "analysis/beliefs/believing_player.h"
#include "strategies/named.h"

#include <folk/analysis/equilibria/examination.h>
#include <folk/analysis/equilibria/played_examination.h>
#include <folk/games/error.h>
#include <folk/strategies/registry.h>
#include <games/expect_error.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <stdexcept>

namespace folk {
namespace {

using test::named;
using test::roster;
/// A machine that nobody can look into.
Strategy opaque(const std::string& name, bool deterministic = true) {
  Strategy strategy;
  strategy.name = "opaque " + name;
  strategy.make_player = [machine = named(name).machine] { return play(machine); };
  strategy.deterministic = deterministic;
  return strategy;
}

ExaminationQuestion question_of(Strategy policy, std::vector<Strategy> opponents, const char* criterion,
                                const char* beliefs = "classics") {
  ExaminationQuestion question;
  question.criterion = Criterion::parse(criterion);
  question.policy = std::move(policy);
  question.opponents = std::move(opponents);
  question.beliefs = roster(beliefs);
  return question;
}

std::string text(const std::optional<Certificate>& certificate) { return certificate ? certificate->text() : "null"; }

TEST(Examination, OfPavlovAgainstItself) {
  const auto found = examine(question_of(named("pavlov"), roster("pavlov"), "discounted:0.6"));
  ASSERT_EQ(found.pairs.size(), 1U);
  const PairExamination& pair = found.pairs.front();
  EXPECT_EQ(pair.opponent, "pavlov");
  EXPECT_EQ(pair.own_score, 3);
  EXPECT_EQ(pair.their_score, 3);
  EXPECT_EQ(pair.method, Method::cycle);
  EXPECT_EQ(pair.path->rounds.size(), 1U);
  EXPECT_TRUE(pair.states.empty());
  EXPECT_FALSE(pair.record);
  EXPECT_EQ(to_text(pair.thresholds->self_confirming_unrestricted->set), "[1/2, 1)");
  EXPECT_EQ(text(found.verdict(Notion::nash)), "refuted");
  EXPECT_EQ(found.verdict(Notion::nash)->margin_exact, "0.5");
  EXPECT_EQ(found.verdict(Notion::nash)->witness, "in round 1, plays D, then best reply");
  EXPECT_EQ(text(found.verdict(Notion::subgame_perfect)), "refuted");
  EXPECT_EQ(text(found.verdict(Notion::self_confirming_unrestricted)), "certified");
  EXPECT_EQ(text(found.verdict(Notion::self_confirming_class)), "certified");
  EXPECT_EQ(found.verdict(Notion::self_confirming_class)->witness, "spiteful");
  EXPECT_EQ(text(found.verdict(Notion::self_confirming_own)), "null");
  EXPECT_EQ(text(found.verdict(Notion::beliefs)), "null");
}

TEST(Examination, OfMachinesThatMixListsTheirSituations) {
  const auto found = examine(question_of(named("random(0.5)"), roster("tit_for_tat"), "discounted:0.9"));
  const PairExamination& pair = found.pairs.front();
  EXPECT_EQ(pair.all_states, 2U);
  ASSERT_EQ(pair.states.size(), 2U);
  EXPECT_TRUE(pair.states[0].history.empty());
  EXPECT_EQ(pair.states[1].history, (std::vector<Outcome>{{Move::D, Move::C}}));
  EXPECT_EQ(pair.states[1].own, 0.5);
  EXPECT_EQ(pair.states[1].theirs, 0);
  EXPECT_FALSE(pair.path);
  EXPECT_FALSE(pair.thresholds);
  EXPECT_EQ(pair.method, Method::markov);
}

/// What a machine that is only played shows of itself is what the machine is: by its path, gains of both sides agree.
TEST(Examination, OfAPlayedPolicyAgreesWithTheMachineItIs) {
  const auto opponents = roster("classics");
  const auto open = examine(question_of(named("pavlov"), opponents, "finite:30"));
  const auto closed = examine(question_of(opaque("pavlov"), opponents, "finite:30"));
  for (std::size_t i = 0; i < opponents.size(); ++i) {
    const auto& a = open.pairs[i];
    const auto& b = closed.pairs[i];
    EXPECT_EQ(a.opponent, b.opponent);
    EXPECT_EQ(a.own_score, b.own_score) << a.opponent;
    EXPECT_EQ(a.their_score, b.their_score) << a.opponent;
    EXPECT_EQ(b.method, Method::played);
    EXPECT_EQ(a.path->rounds, b.path->rounds);
    EXPECT_EQ(a.gaps.first.nash->exact, b.gaps.first.nash->exact) << a.opponent;
    EXPECT_EQ(a.gaps.first.self_confirming_class->exact, b.gaps.first.self_confirming_class->exact) << a.opponent;
    EXPECT_EQ(a.gaps.second.self_confirming_unrestricted->exact, b.gaps.second.self_confirming_unrestricted->exact);
    EXPECT_FALSE(b.gaps.first.subgame_perfect);
    // What others earned against it is less than what the best reply could.
    EXPECT_TRUE(b.gaps.second.nash->bounded());
    EXPECT_LE(b.gaps.second.nash->gain, a.gaps.second.nash->gain) << a.opponent;
  }
}

TEST(Examination, OpponentsMayDoAsOthersDoWhoEarnMore) {
  // Against all_c over 10 rounds tit_for_tat earns 30, per_cd 40 and all_d 50.
  auto question = question_of(opaque("all_c"), roster("tit_for_tat,per_cd"), "finite:10");
  auto found = examine(question);
  EXPECT_EQ(found.pairs[0].gaps.second.nash->gain, 10);
  EXPECT_EQ(found.pairs[0].gaps.second.nash->tried, "the replies of 2 strategies");
  EXPECT_EQ(found.pairs[0].gaps.second.nash->witness.then, "plays like per_cd, who earns more against it");
  EXPECT_EQ(found.pairs[1].gaps.second.nash->gain, 0);
  question.imitated = roster("all_d,per_cd,random(0.5)");  // who is there already counts once, chance not at all
  found = examine(question);
  EXPECT_EQ(found.pairs[0].gaps.second.nash->gain, 20);
  EXPECT_EQ(found.pairs[1].gaps.second.nash->gain, 10);
  EXPECT_EQ(found.pairs[1].gaps.second.nash->tried, "the replies of 3 strategies");
  EXPECT_EQ(text(found.verdict(Notion::nash)), "refuted");
  EXPECT_EQ(found.worst[place_of(Notion::nash)], "tit_for_tat");
}

/// The gain of a machine's opponent is exact, and is not replaced by what others earn.
TEST(Examination, OfAMachineAgainstAPlayedOpponentKnowsHalf) {
  auto question = question_of(named("all_d"), {opaque("tit_for_tat")}, "finite:10", "tit_for_tat,all_d");
  const auto found = examine(question);
  const PairExamination& pair = found.pairs.front();
  EXPECT_FALSE(pair.gaps.first.nash);
  EXPECT_EQ(*pair.gaps.second.nash->exact, 1);
  EXPECT_EQ(text(found.verdict(Notion::nash)), "refuted");
  question.sides = Sides::first;
  EXPECT_EQ(text(examine(question).verdict(Notion::nash)), "null");
}

TEST(Examination, EqualSamplesNeitherRefuteNorCertify) {
  auto question = question_of(opaque("all_d", false), roster("all_d"), "finite:10");
  question.sides = Sides::first;
  const auto at = [&](std::uint64_t repetitions) {
    question.repetitions = repetitions;
    return examine(question);
  };
  const auto found = at(50);
  EXPECT_EQ(found.pairs.front().method, Method::sampled);
  EXPECT_EQ(found.pairs.front().record->matches.size(), 50U);
  const Gap& gap = *found.pairs.front().gaps.first.nash;
  EXPECT_EQ(gap.gain, 0);
  EXPECT_NEAR(gap.residual, 7 * 50 * std::log(2e6) / (3 * 49), 1e-9);
  EXPECT_EQ(gap.tried, "50 sampled matches");
  EXPECT_EQ(text(found.verdict(Notion::nash)), "not refuted (50 sampled matches)");
  EXPECT_FALSE(found.pairs.front().gaps.second.nash);
  EXPECT_FALSE(found.pairs.front().path);
  // Of one match nothing is known at all.
  EXPECT_EQ(at(1).pairs.front().gaps.first.nash->residual, 50);
}

TEST(Examination, EnoughSamplesRefute) {
  auto question = question_of(opaque("all_c", false), roster("all_d"), "finite:10");
  question.sides = Sides::first;
  question.repetitions = 2000;  // 10 are lost in each match
  const auto found = examine(question);
  EXPECT_NEAR(found.pairs.front().gaps.first.nash->gain, 10, 1e-9);
  EXPECT_LT(found.pairs.front().gaps.first.nash->residual, 1);
  EXPECT_EQ(text(found.verdict(Notion::nash)), "refuted");
  question.epsilon_payoff = 10;
  EXPECT_EQ(text(examine(question).verdict(Notion::nash)), "not refuted (2000 sampled matches)");
}

TEST(Examination, JudgesBeliefsAndPlayAgainstThem) {
  // It expects all_d and plays C: each D of the 6 that are tried gains a point; and what it meets is all_c.
  auto question = question_of(test::believer("all_c", "all_d"), roster("all_c,all_d"), "finite:8");
  auto found = examine(question);
  EXPECT_EQ(found.pairs[0].gaps.first.self_confirming_own->gain, 6);
  EXPECT_EQ(found.pairs[0].own_search->gain, 6);
  EXPECT_EQ(found.pairs[0].gaps.first.self_confirming_own->depth, 6U);
  EXPECT_EQ(found.pairs[0].gaps.first.self_confirming_own->witness.deviation, Move::D);
  EXPECT_EQ(text(found.verdict(Notion::self_confirming_own)), "refuted");
  EXPECT_EQ(text(found.pairs[0].verdicts[place_of(Notion::beliefs)]), "refuted");
  EXPECT_EQ(text(found.pairs[1].verdicts[place_of(Notion::beliefs)]), "certified");
  EXPECT_EQ(found.worst[place_of(Notion::beliefs)], "all_c");
  EXPECT_EQ(found.belief->rounds, 16U);
  EXPECT_EQ(found.belief->right, 8U);
  question.epsilon_belief = 1;
  question.depth = 3;
  found = examine(question);
  EXPECT_EQ(text(found.verdict(Notion::beliefs)), "certified");
  EXPECT_EQ(found.pairs[0].gaps.first.self_confirming_own->gain, 3);
}

TEST(Examination, NamesThePairThatIsRefused) {
  test::expect_error<UsageError>(
      [] { examine(question_of(named("all_d"), roster("pavlov,gradual"), "discounted:0.9")); },
      "all_d against gradual: ");
  test::expect_error<UsageError>([] { examine(question_of(named("all_d"), {opaque("pavlov")}, "discounted:0.9")); },
                                 "all_d against opaque pavlov: ");
}

TEST(Examination, TellsWhatIsDoneAndHowFar) {
  std::map<std::string, double> told;
  const Stages stages = [&](const std::string& stage) { return [&told, stage](double share) { told[stage] = share; }; };
  examine(question_of(named("pavlov"), roster("classics"), "finite:5"), stages);
  EXPECT_EQ(told, (std::map<std::string, double>{{"checking pairs", 1}}));
  told.clear();
  examine(question_of(test::believer("pavlov", "pavlov"), roster("all_c,all_d"), "finite:5"), stages);
  EXPECT_EQ(told, (std::map<std::string, double>{{"playing", 1}, {"searching on its own beliefs", 1}}));
}

TEST(MatchScores, AreTotalsOfAMatch) {
  BeliefRecord record{"somebody", false, {}};
  EXPECT_THROW(match_scores(record, {}), std::logic_error);
  record.matches = {{{Move::D, Move::C}, {Move::D, Move::D}}, {{Move::C, Move::D}, {Move::D, Move::D}}};
  const MatchScores scores = match_scores(record, {});  // 6 to 1, then 1 to 6
  EXPECT_EQ(scores.own, 3.5);
  EXPECT_EQ(scores.theirs, 3.5);
  // The unbiased variance of 6 and 1 is 12.5, and two rounds lie at most 10 apart.
  EXPECT_NEAR(scores.error, std::sqrt(12.5 * std::log(2e6)) + 70 * std::log(2e6) / 3, 1e-9);
}

}  // namespace
}  // namespace folk
