#pragma once
// Fixation probabilities, what rare mutations come to, and who took over in simulations, as text, CSV, JSON and files.

#include <folk/tools/ipd_evolve/played_scores.h>
#include <folk/tools/ipd_evolve/question.h>

#include <folk/analysis/evolution/fixation.h>
#include <folk/analysis/evolution/simulated_fixation.h>

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

namespace folk::tools {

/// The answer to --fixation, and to --stationary where there is a distribution.
struct FixationReport {
  const PlayedScores& played;
  const EvolveQuestion& question;
  FixationProbabilities fixation;
  std::vector<double> distribution{};
  std::vector<Rational> exact_distribution{};
  std::uint64_t seed = 1;
  std::string command{};
};

void write_fixation(std::ostream& out, const FixationReport& report, Format format);
void write_fixation_files(const std::filesystem::path& folder, const FixationReport& report);

/// The answer to --runs.
struct RunsReport {
  const PlayedScores& played;
  const EvolveQuestion& question;
  const FixationCounts& counts;
  std::uint64_t seed = 1;
  std::string command{};
};

void write_runs(std::ostream& out, const RunsReport& report, Format format);
void write_runs_files(const std::filesystem::path& folder, const RunsReport& report);

/// Of two strategies, the exact probability that strategy i takes over; nothing for more, and for other models.
std::optional<double> expected_share(const RunsReport& report, std::size_t i);

}  // namespace folk::tools
