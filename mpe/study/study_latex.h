#pragma once
// The study's tables for papers: LaTeX with booktabs, to be read by \input.

#include <folk/mpe/study/study_csv.h>
#include <folk/mpe/study/study_tables.h>

#include <string>
#include <string_view>
#include <vector>

namespace folk::mpe {

/// Any text as LaTeX that prints it; no byte of it is a command.
std::string latex_text(std::string_view text);

/// A table a scenario, a line a learner, under it the paper's line; stars mark what to_paper calls above or below.
std::string scores_latex(const StudyTables& tables);
/// Between the two lines that of the shares within the absolute radius of 0.6; no stars.
std::string accuracy_latex(const StudyTables& tables);
/// A column a point of the curve.
std::string blend_latex(const StudyTables& tables);

/// "scores.tex", "accuracy.tex", "blend.tex" of both, and "tables.tex", a document of them all.
std::vector<NamedText> study_latex_files(const StudyTables& main, const StudyTables& second);

}  // namespace folk::mpe
