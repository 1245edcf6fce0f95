#include <folk/analysis/equilibria/certificate.h>
#include <gtest/gtest.h>

namespace folk {
namespace {

std::vector<Outcome> rounds(const std::string& outcomes) {
  std::vector<Outcome> history;
  for (std::size_t i = 0; i + 1 < outcomes.size(); i += 2)
    history.push_back({outcomes[i] == 'C' ? Move::C : Move::D, outcomes[i + 1] == 'C' ? Move::C : Move::D});
  return history;
}

PairGaps nash_gaps(std::optional<Gap> own, std::optional<Gap> theirs) {
  PairGaps gaps;
  gaps.first.nash = std::move(own);
  gaps.second.nash = std::move(theirs);
  return gaps;
}

Gap gap(const Rational& gain) { return exact_gap(gain, {{}, Move::D, "best reply", {}}); }

Gap bound(const Rational& gain) {
  Gap result = gap(gain);
  result.depth = 6;
  return result;
}

std::string verdict(const PairGaps& gaps, Sides sides = Sides::both, const Rational& epsilon = 0) {
  const auto certificate = judge(gaps, Notion::nash, sides, epsilon);
  return certificate ? certificate->text() : "null";
}

TEST(Certificate, SaysOneOfThreeWords) {
  EXPECT_EQ(verdict(nash_gaps(gap(0), gap(0))), "certified");
  EXPECT_EQ(verdict(nash_gaps(gap(0), gap(1))), "refuted");
  EXPECT_EQ(verdict(nash_gaps(gap(0), gap(1)), Sides::first), "certified");
  EXPECT_EQ(verdict(nash_gaps(gap(0), bound(0))), "not refuted (depth 6)");
  EXPECT_EQ(verdict(nash_gaps(gap(0), bound(2))), "refuted");
  EXPECT_EQ(verdict(nash_gaps(gap(0), std::nullopt)), "not refuted (their side unknown)");
  EXPECT_EQ(verdict(nash_gaps(std::nullopt, std::nullopt)), "null");
}

TEST(Certificate, ComparesGainsThatAreTooSmallForADouble) {
  Rational tiny = 1;
  for (int i = 0; i < 400; ++i) tiny /= 10;
  EXPECT_EQ(to_double(tiny), 0);
  EXPECT_EQ(verdict(nash_gaps(gap(tiny), gap(0))), "refuted");
  EXPECT_EQ(judge(nash_gaps(gap(0), gap(tiny)), Notion::nash, Sides::both, 0)->side, Seat::second);
  EXPECT_EQ(verdict(nash_gaps(gap(tiny), gap(0)), Sides::both, tiny), "certified");
}

TEST(Certificate, WhatIsRoundedIsDecidedOnlyBeyondItsResidual) {
  const Gap rounded = rounded_gap(1, 0.25, {});
  EXPECT_EQ(verdict(nash_gaps(rounded, gap(0)), Sides::both, Rational(1, 2)), "refuted");
  EXPECT_EQ(verdict(nash_gaps(rounded, gap(0)), Sides::both, 2), "certified");
  EXPECT_EQ(verdict(nash_gaps(rounded, gap(0)), Sides::both, 1), "not refuted (rounding 0.2)");
}

TEST(Certificate, WhatRefutesNashRefutesSubgamePerfection) {
  const auto certificate = judge(nash_gaps(gap(3), gap(0)), Notion::subgame_perfect, Sides::both, 0);
  ASSERT_TRUE(certificate);
  EXPECT_EQ(certificate->verdict, Verdict::refuted);
  EXPECT_FALSE(judge(nash_gaps(gap(0), gap(0)), Notion::subgame_perfect, Sides::both, 0));
}

TEST(Certificate, WritesHistoriesWithTheirRepetitionsCounted) {
  EXPECT_EQ(history_text({}), "");
  EXPECT_EQ(history_text(rounds("CCCD")), "CC CD");
  EXPECT_EQ(history_text(rounds("CCCCCC")), "(CC)x3");
  EXPECT_EQ(history_text(rounds("DDCDDCCDDCCDDCCC")), "DD (CD DC)x3 CC");
}

TEST(Certificate, TellsTheDeviationSoThatItCanBeReplayed) {
  EXPECT_EQ(witness_text(exact_gap(1, {rounds("CCCC"), Move::D, "best reply", {}})),
            "in round 3, after CC CC, plays D, then best reply");
  EXPECT_EQ(witness_text(exact_gap(0, {{}, {}, "best reply", "spiteful"})), "spiteful");
}

TEST(Certificate, JudgesBeliefsByTheirLargestDistance) {
  BeliefConsistency beliefs;
  beliefs.add({{Move::C, Move::C, 0.97, 1}, {Move::C, Move::C, 0.99, 1}});
  EXPECT_EQ(judge_beliefs(beliefs, 0.05, true)->text(), "certified");
  EXPECT_EQ(judge_beliefs(beliefs, 0.05, false)->text(), "not refuted (1 sampled matches)");
  EXPECT_EQ(judge_beliefs(beliefs, 0.01, true)->text(), "refuted");
  EXPECT_FALSE(judge_beliefs({}, 0.05, true));
}

}  // namespace
}  // namespace folk
