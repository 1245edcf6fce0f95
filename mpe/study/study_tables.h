#pragma once
// The study's tables, made of its records.

#include <folk/mpe/study/study_record.h>

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace folk::mpe {

/// A mean over training seeds and its 95 % interval's half width. Of several seeds the interval is Student's over their
/// means, but not narrower than what the episodes alone leave open; of one seed it is that of its episodes.
struct Cell {
  double mean = 0;
  double ci95 = 0;
  std::size_t seeds = 0;
};
Cell cell_of(std::span<const Mean> seeds);

/// A cell of a score table, 100 (S - S_random) / (S_expert - S_random); nothing where it was not run.
struct ScoreRow {
  std::string scenario, level, learner, prey;
  std::optional<Cell> score;           ///< transformers: at the target that is best against this prey
  std::optional<Cell> at_data_target;  ///< transformers: at the target that is best against the data's prey
  std::optional<Cell> at_own_target;   ///< transformers: at the data's mean return, which no episode chose
  std::optional<double> paper, paper_sd;
};

/// The score of sct less that of another learner of the same data, seed by seed over the same episodes: the means of
/// report_batches parts of them are subtracted one by one, and the interval of a seed is Student's over the parts.
struct PairedRow {
  std::string scenario, level, prey, learner;
  std::optional<Cell> difference;  ///< over the seeds that both have
};

/// A cell of the accuracy table: the share of steps in which the belief is right at the paper's radius.
struct AccuracyRow {
  std::string scenario, level, learner, prey;
  std::optional<Cell> accuracy;
  std::vector<std::optional<Cell>> right;   ///< at each of belief_radii
  std::vector<std::optional<Cell>> within;  ///< at each of absolute_radii
  std::optional<Cell> distance;
  std::optional<double> paper;
};

/// A point of the blend curve.
struct BlendRow {
  std::string scenario, level, learner;
  double p = 0;
  std::optional<Cell> score;
};

/// What forcing the belief did: difference of the score from that of the free belief, and of the actions.
struct ForcedRow {
  std::string scenario, level, learner, prey, forcing;
  std::optional<Cell> score;       ///< with the belief so forced
  std::optional<Cell> difference;  ///< of the scores, seed by seed
  std::optional<Cell> change;      ///< of an action
};

/// What asking for a return did.
struct AskedRow {
  std::string scenario, level, learner, prey;
  double target = 0;
  std::optional<Cell> score, accuracy;
};

/// Everything that is said of data whose prey was `data_prey`.
struct StudyTables {
  std::string data_prey;
  std::string budget;
  std::vector<ScoreRow> scores;
  std::vector<ScoreRow> players;  ///< who made the data, the rule, random play: learner is the player, level the data's
  std::vector<AccuracyRow> accuracies;
  std::vector<BlendRow> blends;
  std::vector<ForcedRow> forced;
  std::vector<AskedRow> asked;
  std::vector<PairedRow> paired;
  std::vector<std::string> diverged;              ///< trainings that came to nothing: "job: why"
  std::map<std::string, double> data_returns;     ///< "simple_tag-expert": mean return of a predator in the data
  std::map<std::string, Cell> data_prey_returns;  ///< "simple_tag-expert-bc": return against the data's prey
};

/// The paper's own numbers, by "scenario,level,learner,prey" in the words of the study.
struct PaperTables {
  struct Score {
    double score = 0;
    double sd = 0;  ///< over 100 runs
  };
  std::map<std::string, Score> scores;
  std::map<std::string, double> accuracies;
};

/// Reads paper_scores.csv and paper_accuracy.csv of the folder of the shipped policies. Throws InputFileError
/// "file:line: what; mend".
PaperTables read_paper_tables(const std::filesystem::path& players);

/// `records` by the names of their jobs, as read_records gives them. The paper's numbers stand beside those of data
/// whose prey was the released one.
StudyTables study_tables(const std::map<std::string, StudyRecord>& records, const StudySettings& settings,
                         const std::string& data_prey, const PaperTables& paper);

}  // namespace folk::mpe
