#pragma once
// The study's tables as CSV files for other programs.
//
// Every row that the study plans is there; numbers of what was not run are empty and its seeds 0. Scores have four
// decimals, shares and distances six. Words are the study's own (study_plan.h), so that no field needs quotes.

#include <folk/mpe/study/study_tables.h>

#include <string>
#include <vector>

namespace folk::mpe {

/// scenario,level,learner,prey,score,ci95,seeds,budget, then at_data_target,at_data_target_ci95,at_own_target,
/// at_own_target_ci95,paper,paper_sd,to_paper (alike, above or below: study_words.h).
std::string scores_csv(const StudyTables& tables);

/// scenario,level,prey,minus,difference,ci95,seeds,budget: the score of sct less that of the learner `minus`.
std::string paired_csv(const StudyTables& tables);

/// scenario,level,learner,prey,score,ci95,seeds,budget of who learned nothing.
std::string players_csv(const StudyTables& tables);

/// scenario,level,learner,prey,accuracy,ci95,seeds,budget, then within_5,within_20,within_50 (shares at these
/// percentages), within_0.1,within_0.3,within_0.6 (at these absolute radii), distance,paper.
std::string accuracy_csv(const StudyTables& tables);

/// scenario,level,learner,p,score,ci95,seeds,budget.
std::string blend_csv(const StudyTables& tables);

/// scenario,level,learner,prey,belief,score,ci95,seeds,budget,difference,difference_ci95,change,change_ci95.
std::string beliefs_forced_csv(const StudyTables& tables);

/// scenario,level,learner,prey,asked,score,ci95,seeds,budget,accuracy,accuracy_ci95.
std::string returns_asked_csv(const StudyTables& tables);

/// scenario,level,learner,return,ci95,seeds,budget,data_return: unnormalised, of one predator against the data's prey,
/// and the mean return in the data.
std::string returns_csv(const StudyTables& tables);

/// A file's name and its bytes.
struct NamedText {
  std::string name;
  std::string text;
};

/// All of them: "scores.csv", ...; of data with another prey than the paper's "trained_prey_scores.csv", ...
std::vector<NamedText> study_csv_files(const StudyTables& tables);

}  // namespace folk::mpe
