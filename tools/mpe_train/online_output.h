#pragma once
// What an online training run reports.

#include <folk/tools/program/program.h>

#include <folk/mpe/online/training.h>

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace folk::tools {

struct OnlineReport {
  const mpe::OnlineTraining& training;
  std::string description;
  std::size_t kept = 0;               ///< index of the evaluation whose policy is written
  std::optional<std::size_t> medium;  ///< of the medium policy's, where one is asked for
  std::filesystem::path output, curve, picture, medium_file, prey_file;  ///< empty: not written
};

/// The rule by which a policy is kept: of a prey that stays as it is the highest mean return, of equals the latest;
/// where the prey learns too the last, as returns then do not compare.
std::size_t kept_evaluation(const mpe::OnlineTraining& training);

/// The evaluation whose return is nearest to this one, of equals the earliest.
std::size_t nearest_evaluation(const mpe::OnlineTraining& training, double predators);

/// A CSV, a row an evaluation.
void write_evaluations(std::ostream& out, const std::vector<mpe::OnlineEvaluation>& history);

void draw_evaluations(const mpe::OnlineTraining& training, std::size_t kept, const std::filesystem::path& picture);

void write_report(std::ostream& out, const OnlineReport& report, Format format);

}  // namespace folk::tools
