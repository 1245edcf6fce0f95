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
/// Nothing where either is missing, nor against the prey maddpg: the paper's of that name is another one, whose weights
/// do not exist.
std::optional<ToPaper> to_paper(const ScoreRow& row);

/// How often a belief lies within the absolute radius that explains the paper's accuracies (beliefs.h).
inline constexpr std::size_t inferred_radius = 2;
static_assert(absolute_radii[inferred_radius] == 0.6);
std::optional<Cell> within_inferred(const AccuracyRow& row);

}  // namespace folk::mpe
