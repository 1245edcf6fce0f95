#pragma once
// A finished evaluation as text, CSV, JSON and files.

#include <folk/tools/mpe_evaluate/play.h>

#include <filesystem>
#include <ostream>

namespace folk::tools {

/// A row a prey under a header that states every setting, and what the references are.
void write_text(std::ostream& out, const EvaluationSettings& settings, const Evaluation& evaluation);

/// A row a prey.
void write_csv(std::ostream& out, const EvaluationSettings& settings, const Evaluation& evaluation);

/// One object; docs/mpe-evaluate.md says what it holds.
void write_json(std::ostream& out, const EvaluationSettings& settings, const Evaluation& evaluation);

/// results.csv, results.json and episodes.csv, a row an episode, in `folder`, each written whole or not at all.
void write_files(const std::filesystem::path& folder, const EvaluationSettings& settings, const Evaluation& evaluation);

}  // namespace folk::tools
