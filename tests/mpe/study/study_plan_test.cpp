// The study's list of jobs.

#include <folk/mpe/study/study_plan.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "games/expect_error.h"

namespace folk::mpe {
namespace {

using folk::test::expect_error;

std::size_t jobs_of(Budget budget, std::uint64_t seeds, const std::vector<std::string>& only = {}) {
  return study_jobs(StudySettings::of(budget, seeds), only).size();
}

TEST(StudyPlan, HasAJobForEverySeed) {
  // 14 examinations of players; one seed of 6 learners on 3 levels and on the other prey's data, and of the paper's
  // loss, in 2 scenarios; further seeds of all but the level random.
  EXPECT_EQ(jobs_of(Budget::small, 1), 14U + 2 * (6 * 4 + 1));
  EXPECT_EQ(jobs_of(Budget::small, 3), 140U);
  EXPECT_EQ(jobs_of(Budget::paper, 3), 140U);
  EXPECT_EQ(jobs_of(Budget::smoke, 3), 64U);
}

TEST(StudyPlan, HasEachJobOnce) {
  const auto jobs = study_jobs(StudySettings::of(Budget::small, 3));
  std::set<std::string> names;
  std::set<std::uint64_t> seeds_of_random;
  for (const auto& job : jobs) {
    EXPECT_TRUE(names.insert(job.name()).second) << job.name();
    if (job.level == "random") seeds_of_random.insert(job.seed);
    if (job.learner == "sct-selfconf") {
      EXPECT_EQ(job.data_prey + job.level, "releasedexpert");
    }
    EXPECT_NE(std::find(study_scenarios().begin(), study_scenarios().end(), job.scenario), study_scenarios().end());
  }
  EXPECT_EQ(seeds_of_random, std::set<std::uint64_t>{1});
  EXPECT_TRUE(names.contains("released-simple_tag-expert-sct-3"));
  EXPECT_TRUE(names.contains("maddpg-simple_world-none-random_play-1"));
}

TEST(StudyPlan, HasThePapersCells) {
  std::set<std::string> cells;
  for (const auto& job : study_jobs(StudySettings::of(Budget::smoke)))
    if (job.data_prey == "released" && job.learns() && job.learner != "sct-selfconf")
      for (const auto& prey : table_preys()) cells.insert(job.data() + job.learner + prey);
  EXPECT_EQ(cells.size(), 180U);
}

TEST(StudyPlan, BeginsWithOneSeedOfEverything) {
  const auto jobs = study_jobs(StudySettings::of(Budget::small, 3));
  const auto first = study_jobs(StudySettings::of(Budget::small, 1));
  ASSERT_LT(first.size(), jobs.size());
  EXPECT_TRUE(std::equal(first.begin(), first.end(), jobs.begin()));
  EXPECT_TRUE(std::all_of(first.begin(), first.end(), [](const StudyJob& job) { return job.seed == 1; }));
}

TEST(StudyPlan, WordsChooseJobs) {
  EXPECT_EQ(jobs_of(Budget::small, 3, {"sct", "madt", "simple_tag", "expert"}), 2U * 3 * 2);
  EXPECT_EQ(jobs_of(Budget::small, 3, {"sct", "madt", "simple_tag", "expert", "seed1", "released"}), 2U);
  EXPECT_EQ(jobs_of(Budget::small, 3, {"random"}), 12U);
  EXPECT_EQ(jobs_of(Budget::small, 3, {"random_play"}), 4U);
  EXPECT_EQ(jobs_of(Budget::small, 3, {"random", "seed2"}), 0U);
  for (const auto& job : study_jobs(StudySettings::of(Budget::small, 3), {"omar", "seed2"}))
    EXPECT_EQ(job.learner + fmt::to_string(job.seed), "omar2");
}

TEST(StudyPlan, UnknownWordsAreRefused) {
  for (const char* word : {"sc", "SCT", "seed4", "", "simple"})
    expect_error<UsageError>(
        [&] {
          jobs_of(Budget::small, 3, {"sct", word});
        },
        "'" + std::string(word) + "': no job of the study has this; expected of ");
  expect_error<UsageError>([] { jobs_of(Budget::small, 3, {"a\nb"}); }, "'a?b'");
  expect_error<UsageError>([] { jobs_of(Budget::small, 1, {"seed2"}); }, "'seed2'");
}

TEST(StudyPlan, AskedReturnsGoAsFarAsReturnsDo) {
  EXPECT_EQ(target_grid({"released", "simple_tag", "expert", "sct", 1}),
            (std::vector<double>{0, 80, 160, 240, 320, 400, 480}));
  EXPECT_EQ(target_grid({"released", "simple_world", "medium", "madt", 2}),
            (std::vector<double>{0, 40, 80, 120, 160, 200, 240}));
  for (const auto& scenario : study_scenarios())
    EXPECT_EQ(target_grid({"maddpg", scenario, "expert", "sct", 1}),
              (std::vector<double>{0, 20, 40, 60, 80, 100, 120}));
}

TEST(StudyPlan, PreysAreThoseOfBothTables) {
  EXPECT_EQ(study_preys(), (std::vector<std::string>{"released", "maddpg", "still", "random(program)", "blend(0.5)",
                                                     "blend(0.7)", "blend(0.3)"}));
}

TEST(StudyPlan, JobsTrainWhatTheirNamesSay) {
  const auto settings = StudySettings::of(Budget::small);
  const auto own = choice_of({"released", "simple_tag", "medium", "sct", 3}, settings);
  EXPECT_EQ(own.kind, LearnerKind::sct);
  EXPECT_EQ(own.seed, 3U);
  EXPECT_EQ(own.level, "medium");
  EXPECT_EQ(own.loss, std::nullopt);
  const auto papers = choice_of({"released", "simple_tag", "expert", "sct-selfconf", 1}, settings);
  EXPECT_EQ(papers.kind, LearnerKind::sct);
  EXPECT_EQ(papers.loss, sct::LossMode::selfconf);
  const StudyJob rule{"released", "simple_tag", "none", "lead_pursuit", 1};
  EXPECT_FALSE(rule.learns());
  EXPECT_FALSE(rule.transformer());
}

}  // namespace
}  // namespace folk::mpe
