#pragma once
// What the reports of the study call things, and how they hold a number against the paper's.

#include <folk/mpe/study/study_tables.h>

#include <optional>
#include <string>
#include <string_view>

namespace folk::mpe {

/// "ma-bcq" as "MA-BCQ", "random(program)" as "random"; a word without a title stands for itself.
std::string learner_title(std::string_view learner);
std::string prey_title(std::string_view prey);
/// Of to_string(BeliefForcing): "the truth" for "truth".
std::string forcing_title(std::string_view forcing);

/// What the names of the files of these tables begin with: nothing for the paper's data, else "trained_prey_".
std::string file_prefix(const StudyTables& tables);

/// A number with so many decimals; what rounds to zero has no sign.
std::string fixed(double value, int decimals);

/// Half the width of the 95 % interval of one of the paper's means, of which it prints the standard deviation over 100
/// runs (Student's t with 99 degrees of freedom).
double paper_ci95(double sd);

/// How a number lies to the paper's: alike unless the two 95 % intervals leave room between them.
enum class ToPaper { alike, above, below };
/// Nothing where either is missing. The paper prints no spread of its accuracies: they are taken as exact but for their
/// rounding to three decimals.
std::optional<ToPaper> to_paper(const ScoreRow& row);
std::optional<ToPaper> to_paper(const AccuracyRow& row);

}  // namespace folk::mpe
