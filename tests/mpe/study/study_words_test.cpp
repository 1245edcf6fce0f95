#include <folk/mpe/study/study_words.h>

#include <gtest/gtest.h>

#include "mpe/study/made_up_tables.h"

namespace folk::mpe {
namespace {

ScoreRow score(double mean, double ci95, double paper, double sd) {
  return {"simple_tag", "expert", "sct", "still", Cell{mean, ci95, 3}, {}, {}, paper, sd};
}

TEST(StudyWords, ScoresLieToThePaperByBothIntervals) {
  // 10 of deviation over 100 runs: 1.984 of interval.
  EXPECT_EQ(to_paper(score(103.9, 2, 100, 10)), ToPaper::alike);
  EXPECT_EQ(to_paper(score(96.1, 2, 100, 10)), ToPaper::alike);
  EXPECT_EQ(to_paper(score(104.1, 2, 100, 10)), ToPaper::above);
  EXPECT_EQ(to_paper(score(95.9, 2, 100, 10)), ToPaper::below);
  auto row = score(95.9, 2, 100, 10);
  row.paper.reset();
  EXPECT_EQ(to_paper(row), std::nullopt);
  row = score(95.9, 2, 100, 10);
  row.score.reset();
  EXPECT_EQ(to_paper(row), std::nullopt);
}

TEST(StudyWords, NothingIsHeldAgainstAnotherPreyOfTheSameName) {
  auto row = score(95.9, 2, 100, 10);
  row.prey = "maddpg";
  EXPECT_EQ(to_paper(row), std::nullopt);
}

TEST(StudyWords, BeliefsLieWithinTheRadiusThatExplainsThePapers) {
  AccuracyRow row{"simple_tag", "expert", "sct", "still", Cell{0.7, 0.01, 3}, {}, {}, {}, 0.71};
  EXPECT_FALSE(within_inferred(row).has_value());
  row.within = {Cell{0.1, 0, 3}, Cell{0.3, 0, 3}, {}};
  EXPECT_FALSE(within_inferred(row).has_value());
  row.within[2] = Cell{0.6, 0, 3};
  ASSERT_TRUE(within_inferred(row).has_value());
  EXPECT_EQ(within_inferred(row)->mean, 0.6);
}

TEST(StudyWords, NumbersHaveNoSignOfNothing) {
  EXPECT_EQ(fixed(-0.04, 1), "0.0");
  EXPECT_EQ(fixed(-0.06, 1), "-0.1");
  EXPECT_EQ(fixed(-10, 0), "-10");
  EXPECT_EQ(fixed(1.25, 3), "1.250");
}

TEST(StudyWords, EveryWordOfTheStudyHasATitle) {
  for (const auto& learner : study_learners()) EXPECT_NE(learner_title(learner), learner);
  for (const auto& player : study_players()) EXPECT_NE(learner_title(player), player);
  for (const auto forcing :
       {BeliefForcing::none, BeliefForcing::truth, BeliefForcing::other_episode, BeliefForcing::zero})
    EXPECT_NE(forcing_title(to_string(forcing)), to_string(forcing));
  EXPECT_EQ(prey_title("random(program)"), "random");
  EXPECT_EQ(prey_title("maddpg"), "maddpg");
}

}  // namespace
}  // namespace folk::mpe
