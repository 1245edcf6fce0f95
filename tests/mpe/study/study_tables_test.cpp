// The study's tables, made of a few records and held against sums by hand.

#include <folk/mpe/study/study_tables.h>

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "games/expect_error.h"
#include "mpe/data/small_data_set.h"

namespace folk::mpe {
namespace {

using folk::test::expect_error;
using Records = std::map<std::string, StudyRecord>;

// Student's 0.975 quantiles, from a printed table.
constexpr double student_1 = 12.7062047362;
constexpr double student_2 = 4.30265272975;
constexpr double student_15 = 2.13144954556;
constexpr double close = 1e-6;

constexpr double tag_unit = 100 / (185.6 + 4.1);  // of the published references

/// Returns are the same against each prey, ± 1, in all batches.
StudyRecord record(const StudyJob& job, double returned) {
  StudyRecord made;
  made.job = job;
  made.budget = "small";
  made.data_return = 100;
  for (const auto& name : study_preys()) {
    PreyRecord prey;
    prey.prey = name;
    prey.predators = {returned, 1};
    prey.batches.assign(report_batches, returned);
    made.preys.push_back(prey);
  }
  return made;
}

StudyJob job(const std::string& learner, std::uint64_t seed = 1, const std::string& data_prey = "released") {
  return {data_prey, "simple_tag", "expert", learner, seed};
}

Records records_of(const std::vector<StudyRecord>& all) {
  Records records;
  for (const auto& one : all) records[one.job.name()] = one;
  return records;
}

StudyTables tables_of(const Records& records, const std::string& data_prey = "released",
                      const PaperTables& paper = {}) {
  return study_tables(records, StudySettings::of(Budget::small), data_prey, paper);
}

PreyRecord& against(StudyRecord& made, const std::string& prey) {
  for (auto& one : made.preys)
    if (one.prey == prey) return one;
  throw UsageError(prey);
}

/// The row of simple_tag, expert data.
template <class Row>
const Row& row_of(const std::vector<Row>& rows, const std::string& learner, const std::string& prey) {
  for (const auto& row : rows)
    if (row.scenario == "simple_tag" && row.learner == learner && row.prey == prey &&
        (row.level == "expert" || row.level == "none"))
      return row;
  throw UsageError(learner + " against " + prey);
}

void expect_cell(const std::optional<Cell>& cell, double mean, double ci95, std::size_t seeds) {
  ASSERT_TRUE(cell.has_value());
  EXPECT_NEAR(cell->mean, mean, close);
  EXPECT_NEAR(cell->ci95, ci95, close);
  EXPECT_EQ(cell->seeds, seeds);
}

TEST(StudyCell, OfOneSeedHasTheIntervalOfItsEpisodes) { expect_cell(cell_of(std::vector<Mean>{{10, 2}}), 10, 2, 1); }

TEST(StudyCell, OfSeveralHasStudents) {
  expect_cell(cell_of(std::vector<Mean>{{10, 0}, {14, 0}}), 12, 2 * student_1, 2);
  // Squares 4 + 1 + 9 about 3, by 2 degrees of freedom and 3 seeds.
  expect_cell(cell_of(std::vector<Mean>{{1, 0.5}, {2, 0.5}, {6, 0.5}}), 3, student_2 * std::sqrt(14.0 / 6), 3);
}

TEST(StudyCell, IsNotNarrowerThanItsEpisodesAloneLeaveOpen) {
  expect_cell(cell_of(std::vector<Mean>{{10, 3}, {10, 4}}), 10, 2.5, 2);
  expect_cell(cell_of(std::vector<Mean>{{10, 1}, {10, 2}, {10, 2}}), 10, 1, 3);
}

TEST(StudyTables, ScoresOfTheReleasedPreyHaveThePublishedReferences) {
  auto transformer = record(job("sct"), 185.6);
  auto& still = against(transformer, "still");
  still.predators = {90.75, 18.97};
  still.data_target_predators = Mean{-4.1, 1.897};
  still.own_target_predators = Mean{185.6, 3.794};
  const auto tables = tables_of(records_of({transformer, record(job("bc"), -4.1)}));
  EXPECT_EQ(tables.budget, "small");
  expect_cell(row_of(tables.scores, "sct", "released").score, 100, tag_unit, 1);
  expect_cell(row_of(tables.scores, "sct", "still").score, 50, 10, 1);
  expect_cell(row_of(tables.scores, "sct", "still").at_data_target, 0, 1, 1);
  expect_cell(row_of(tables.scores, "sct", "still").at_own_target, 100, 2, 1);
  expect_cell(row_of(tables.scores, "bc", "still").score, 0, tag_unit, 1);
  EXPECT_FALSE(row_of(tables.scores, "bc", "still").at_data_target.has_value());
  EXPECT_FALSE(row_of(tables.scores, "bc", "still").at_own_target.has_value());
  EXPECT_EQ(tables.data_returns, (std::map<std::string, double>{{"simple_tag-expert", 100}}));
  expect_cell(tables.data_prey_returns.at("simple_tag-expert-sct"), 185.6, 1, 1);
}

TEST(StudyTables, ScoresOfAnotherPreyHaveMeasuredReferences) {
  const StudyJob random{"maddpg", "simple_tag", "none", "random_play", 1};
  auto expert = record(job("matd3", 1, "maddpg"), 500);
  against(expert, "maddpg").predators.mean = 80;
  auto nobody = record(random, -500);
  against(nobody, "maddpg").predators.mean = 30;
  auto records = records_of({expert, nobody, record(job("sct", 1, "maddpg"), 55)});
  const auto tables = tables_of(records, "maddpg");
  expect_cell(row_of(tables.scores, "sct", "still").score, 50, 2, 1);
  expect_cell(row_of(tables.players, "matd3", "maddpg").score, 100, 2, 1);
  EXPECT_EQ(tables.data_prey, "maddpg");
  // Without either there are no scores.
  for (const auto& missing : {expert.job.name(), random.name()}) {
    auto fewer = records;
    fewer.erase(missing);
    const auto without = tables_of(fewer, "maddpg");
    EXPECT_FALSE(row_of(without.scores, "sct", "still").score.has_value());
    EXPECT_FALSE(row_of(without.paired, "madt", "still").difference.has_value());
  }
}

TEST(StudyTables, EveryPlannedCellIsThere) {
  const auto tables = tables_of({});
  EXPECT_EQ(tables.scores.size(), 190U);  // the paper's 180, and the paper's loss on expert data
  EXPECT_EQ(tables.accuracies.size(), 2U * (3 * 2 + 1) * 5);
  EXPECT_EQ(tables.paired.size(), 2U * (6 + 5 + 5) * 5);
  EXPECT_EQ(tables_of({}, "maddpg").paired.size(), 2U * 5 * 5);
  for (const auto& row : tables.scores) EXPECT_FALSE(row.score || row.at_data_target || row.at_own_target || row.paper);
  for (const auto& row : tables.paired) {
    EXPECT_FALSE(row.difference.has_value());
    EXPECT_NE(row.learner, "sct");
  }
  for (const auto& row : tables.accuracies) {
    EXPECT_EQ(row.right.size(), belief_radii.size());
    EXPECT_EQ(row.within.size(), absolute_radii.size());
    EXPECT_FALSE(row.accuracy || row.within[2] || row.distance);
  }
  EXPECT_TRUE(tables.diverged.empty());
  EXPECT_TRUE(tables.data_returns.empty());
}

TEST(StudyTables, CellsAreOverTheSeedsThatAreThere) {
  const auto tables = tables_of(records_of({record(job("sct", 1), 185.6), record(job("sct", 3), -4.1)}));
  expect_cell(row_of(tables.scores, "sct", "still").score, 50, 50 * student_1, 2);
  EXPECT_FALSE(row_of(tables.scores, "madt", "still").score.has_value());
}

TEST(StudyTables, AccuraciesHaveTheirRadii) {
  auto one = record(job("sct"), 100);
  RightBeliefs beliefs;
  beliefs.right = {Mean{0.1, 0.01}, Mean{0.2, 0.02}, Mean{0.3, 0.03}, Mean{0.4, 0.04}};
  beliefs.within = {Mean{0.5, 0.05}, Mean{0.6, 0.06}, Mean{0.7, 0.07}};
  beliefs.distance = {0.8, 0.08};
  against(one, "still").beliefs = beliefs;
  const auto tables = tables_of(records_of({one}));
  const auto& row = row_of(tables.accuracies, "sct", "still");
  expect_cell(row.accuracy, 0.2, 0.02, 1);
  expect_cell(row.right[3], 0.4, 0.04, 1);
  expect_cell(row.within[0], 0.5, 0.05, 1);
  expect_cell(row.within[2], 0.7, 0.07, 1);
  expect_cell(row.distance, 0.8, 0.08, 1);
  EXPECT_FALSE(row_of(tables.accuracies, "sct", "released").accuracy.has_value());
}

// ---- paired differences ------------------------------------------------------------------------------------------

/// sct of two seeds: the first lies 10, 11, ..., 25 above madt's, the second 7.5 in each batch.
Records pairs() {
  auto sct1 = record(job("sct", 1), 0), madt1 = record(job("madt", 1), 0);
  for (std::size_t b = 0; b < report_batches; ++b) {
    const double both = 50.0 * static_cast<double>(b % 3);
    against(madt1, "still").batches[b] = both;
    against(sct1, "still").batches[b] = both + 10 + static_cast<double>(b);
  }
  return records_of({sct1, madt1, record(job("sct", 2), 107.5), record(job("madt", 2), 100)});
}

TEST(StudyTables, DifferencesArePairedBatchByBatch) {
  auto records = pairs();
  records.erase(job("sct", 2).name());
  // 0, ..., 15 have squares of 340 about their mean.
  const double half = student_15 * std::sqrt(340.0 / 15 / 16);
  const auto tables = tables_of(records);
  expect_cell(row_of(tables.paired, "madt", "still").difference, 17.5 * tag_unit, half * tag_unit, 1);
  expect_cell(row_of(tables.paired, "madt", "released").difference, 0, 0, 1);
  EXPECT_FALSE(row_of(tables.paired, "bc", "still").difference.has_value());
}

TEST(StudyTables, DifferencesAreOverTheSeedsThatBothHave) {
  auto records = pairs();
  const auto third = record(job("madt", 3), 1e6);
  records[third.job.name()] = third;
  auto tables = tables_of(records);
  expect_cell(row_of(tables.paired, "madt", "still").difference, 12.5 * tag_unit, 5 * student_1 * tag_unit, 2);
  // Other data of the same seeds are no pair.
  for (const auto& row : tables.paired)
    if (row.level != "expert" || row.scenario != "simple_tag") {
      EXPECT_FALSE(row.difference.has_value());
    }
  records.erase(job("madt", 2).name());
  tables = tables_of(records);
  ASSERT_TRUE(row_of(tables.paired, "madt", "still").difference.has_value());
  EXPECT_EQ(row_of(tables.paired, "madt", "still").difference->seeds, 1U);
}

TEST(StudyTables, WithoutBatchesThereIsNoDifference) {
  auto records = pairs();
  against(records.at(job("madt", 1).name()), "still").batches.clear();
  against(records.at(job("sct", 2).name()), "still").batches.clear();
  const auto tables = tables_of(records);
  EXPECT_FALSE(row_of(tables.paired, "madt", "still").difference.has_value());
  EXPECT_TRUE(row_of(tables.paired, "madt", "released").difference.has_value());
}

// ---- what diverged -----------------------------------------------------------------------------------------------

TEST(StudyTables, NameWhatDiverged) {
  StudyRecord diverged;
  diverged.job = job("omar");
  diverged.diverged = "training has diverged:\nloss is inf";
  const auto records = records_of({diverged, record(job("sct"), 0)});
  const auto tables = tables_of(records);
  EXPECT_EQ(tables.diverged,
            (std::vector<std::string>{"released-simple_tag-expert-omar-1: training has diverged:?loss is inf"}));
  EXPECT_FALSE(row_of(tables.scores, "omar", "still").score.has_value());
  EXPECT_FALSE(row_of(tables.paired, "omar", "still").difference.has_value());
  EXPECT_TRUE(tables_of(records, "maddpg").diverged.empty());
}

// ---- the paper's numbers -----------------------------------------------------------------------------------------

PaperTables shipped() { return read_paper_tables(FOLK_SOURCE_DIR "/data/mpe"); }

TEST(PaperTables, AreRead) {
  const auto paper = shipped();
  EXPECT_EQ(paper.scores.size(), 180U);
  EXPECT_EQ(paper.accuracies.size(), 60U);
  EXPECT_EQ(paper.scores.at("simple_tag,expert,omar,released").score, 103.19);
  EXPECT_EQ(paper.scores.at("simple_tag,expert,omar,released").sd, 8.29);
  EXPECT_EQ(paper.accuracies.at("simple_tag,expert,sct,still"), 0.978);
  EXPECT_EQ(paper.accuracies.at("simple_tag,expert,rmadt,blend(0.5)"), 0.69);
  EXPECT_EQ(paper.accuracies.at("simple_world,random,rmadt,random(program)"), 0.287);
}

TEST(PaperTables, StandBesideTheScoresOfTheirDataAlone) {
  const auto tables = tables_of({}, "released", shipped());
  std::size_t scores = 0, accuracies = 0;
  for (const auto& row : tables.scores) scores += row.paper && row.paper_sd ? 1U : 0U;
  for (const auto& row : tables.accuracies) accuracies += row.paper ? 1U : 0U;
  EXPECT_EQ(scores, 180U);
  EXPECT_EQ(accuracies, 60U);
  EXPECT_EQ(row_of(tables.scores, "ma-bcq", "blend(0.5)").paper,
            shipped().scores.at("simple_tag,expert,ma-bcq,blend(0.5)").score);
  for (const auto& row : tables_of({}, "maddpg", shipped()).scores) EXPECT_FALSE(row.paper || row.paper_sd);
}

TEST(PaperTables, ThatAreDamagedAreRefused) {
  const auto refused = [](const std::string& scores, const std::string& part) {
    const test::Folder folder;
    std::ofstream(folder / "paper_scores.csv") << scores;
    std::ofstream(folder / "paper_accuracy.csv") << "scenario,level,learner,prey,accuracy\n";
    expect_error<InputFileError>([&] { read_paper_tables(folder.path()); }, part);
  };
  const std::string header = "scenario,level,learner,prey,score,sd\n";
  refused("scenario,level\n", "paper_scores.csv:1: expected the header scenario,level,learner,prey,score,sd");
  refused(header + "simple_tag,expert,BC,still,1,2\nsimple_tag,expert\n", "paper_scores.csv:3: 2 fields: expected 6");
  refused(header + "simple_tag,expert,BC,still,much,2\n", "paper_scores.csv: ");
}

}  // namespace
}  // namespace folk::mpe
