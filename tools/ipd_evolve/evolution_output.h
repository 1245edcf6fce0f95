#pragma once
// What became of a population, as text, CSV, JSON and files.

#include <folk/tools/ipd_evolve/played_scores.h>
#include <folk/tools/ipd_evolve/question.h>

#include <folk/analysis/evolution/evolution.h>

#include <filesystem>
#include <ostream>
#include <string>

namespace folk::tools {

/// All that an output needs to be written.
struct EvolutionReport {
  const PlayedScores& played;
  const EvolveQuestion& question;
  const Evolution& evolution;
  std::string command;

  /// Share of C in all moves, nothing where it is not known.
  std::optional<double> cooperation(const Population& population) const;
  std::uint64_t signature() const;
};

void write_evolution_text(std::ostream& out, const EvolutionReport& report);

/// rank,name,population,extinct_at_generation, best first.
void write_evolution_csv(std::ostream& out, const EvolutionReport& report);
void write_evolution_json(std::ostream& out, const EvolutionReport& report, bool as_file);

/// ranking.csv, populations.csv (a row a kept generation), cooperation.csv where it is known, summary.json.
void write_evolution_files(const std::filesystem::path& folder, const EvolutionReport& report);

/// Which strategies are left, in rank order: whole individuals, and shares above the model's tolerance.
std::vector<std::size_t> survivors(const Evolution& evolution);

/// "after 25 generations a fixed point".
std::string how_it_ended(const Evolution& evolution);

}  // namespace folk::tools
