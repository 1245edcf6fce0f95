#include <folk/analysis/equilibria/verdict_summary.h>
#include <gtest/gtest.h>

namespace folk {
namespace {

Certificates nash_is(Verdict verdict, double margin = 0) {
  Certificate certificate;
  certificate.verdict = verdict;
  certificate.margin = margin;
  Certificates all;
  all[place_of(Notion::nash)] = certificate;
  return all;
}

constexpr std::size_t nash = place_of(Notion::nash);

TEST(VerdictSummary, KeepsTheWorstAndItsName) {
  VerdictSummary summary;
  summary.add(nash_is(Verdict::certified, 9), "a");
  EXPECT_EQ(summary.worst()[nash], "a");
  summary.add(nash_is(Verdict::not_refuted, 1), "b");
  EXPECT_EQ(summary.worst()[nash], "b");
  summary.add(nash_is(Verdict::certified, 20), "c");
  EXPECT_EQ(summary.worst()[nash], "b");
  summary.add(nash_is(Verdict::refuted, 0.5), "d");
  EXPECT_EQ(summary.worst()[nash], "d");
  summary.add(nash_is(Verdict::not_refuted, 30), "e");
  EXPECT_EQ(summary.worst()[nash], "d");
  EXPECT_EQ(summary.overall()[nash]->text(), "refuted");
  EXPECT_EQ(summary.overall()[nash]->margin, 0.5);
}

TEST(VerdictSummary, OfEqualWordsKeepsTheLargerMarginAndThenTheFirst) {
  VerdictSummary summary;
  summary.add(nash_is(Verdict::refuted, 1), "a");
  summary.add(nash_is(Verdict::refuted, 2), "b");
  summary.add(nash_is(Verdict::refuted, 2), "c");
  summary.add(nash_is(Verdict::refuted, 1), "d");
  EXPECT_EQ(summary.worst()[nash], "b");
}

TEST(VerdictSummary, CertifiesNothingThatIsUndecidedForSome) {
  VerdictSummary summary;
  summary.add({}, "a");
  EXPECT_FALSE(summary.overall()[nash]);
  EXPECT_EQ(summary.worst()[nash], "");
  summary.add(nash_is(Verdict::certified), "b");
  summary.add({}, "c");
  EXPECT_EQ(summary.overall()[nash]->text(), "not refuted (undecided for 2 opponents)");
  EXPECT_EQ(summary.worst()[nash], "b");
  summary.add(nash_is(Verdict::refuted, 1), "d");
  EXPECT_EQ(summary.overall()[nash]->text(), "refuted");  // known for one is enough
}

TEST(VerdictSummary, KeepsEachNotionByItself) {
  VerdictSummary summary;
  summary.add(nash_is(Verdict::certified), "a");
  Certificates both = nash_is(Verdict::certified);
  both[place_of(Notion::beliefs)] = nash_is(Verdict::refuted)[nash];
  summary.add(both, "b");
  EXPECT_EQ(summary.overall()[nash]->text(), "certified");
  EXPECT_EQ(summary.worst()[nash], "a");
  EXPECT_EQ(summary.worst()[place_of(Notion::beliefs)], "b");
}

TEST(JudgeAll, JudgesWhatIsKnownOfGains) {
  PairGaps gaps;
  gaps.first.nash = exact_gap(2, {});
  gaps.second.nash = exact_gap(0, {});
  gaps.first.self_confirming_own = exact_gap(0, {});
  const Certificates all = judge_all(gaps, Sides::both, 1);
  EXPECT_EQ(all[nash]->text(), "refuted");
  EXPECT_EQ(all[place_of(Notion::self_confirming_own)]->text(), "certified");
  EXPECT_FALSE(all[place_of(Notion::self_confirming_class)]);
  EXPECT_FALSE(all[place_of(Notion::beliefs)]);
  EXPECT_EQ(judge_all(gaps, Sides::both, 2)[nash]->text(), "certified");
  EXPECT_EQ(judge_all(gaps, Sides::second, 1)[nash]->text(), "certified");
}

}  // namespace
}  // namespace folk
