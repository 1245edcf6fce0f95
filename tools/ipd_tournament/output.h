#pragma once
// A finished tournament as text, CSV, JSON and files.

#include <folk/analysis/evolution/invasion.h>
#include <folk/analysis/tournament/sub_rosters.h>
#include <folk/analysis/tournament/tournament.h>

#include <filesystem>
#include <ostream>
#include <string>

namespace folk::tools {

/// What the output says beside the results.
struct TournamentLabels {
  std::string roster;     ///< the SPEC as the user wrote it
  std::string included;   ///< the --include SPEC, or nothing
  std::string game;       ///< its title
  std::string command{};  ///< the command line
};

/// What was asked for beside the ranking; null where it was not.
struct TournamentExtras {
  const Invasions* invasions = nullptr;
  const SubRosters* sub_rosters = nullptr;
};

/// The ranking as aligned columns under a header that states every setting, what else was asked for below it.
void write_text(std::ostream& out, const Tournament& tournament, const TournamentLabels& labels,
                const TournamentExtras& extras);

/// The ranking alone.
void write_ranking_csv(std::ostream& out, const Tournament& tournament, const TournamentExtras& extras);

/// One object: settings, ranking and (with_matrices) scores, cooperations, normalised, belief_accuracy; matrices are
/// written cell by cell. Without them it is what a file keeps: Folk's version and the command line too.
void write_json(std::ostream& out, const Tournament& tournament, const TournamentLabels& labels, bool with_matrices,
                const TournamentExtras& extras);

/// pairs.csv is written for up to so many entrants: it has a row a pair.
inline constexpr std::size_t most_listed_pairs = 1000;

/// ranking.csv, scores.csv, cooperation.csv, pairs.csv, summary.json and, where somebody holds beliefs, beliefs.csv
/// and, where they were asked for, invasion.csv and sub_rosters.csv in `folder`, each written whole or not at all.
/// Throws EnvironmentError when the folder cannot be made or written.
void write_files(const std::filesystem::path& folder, const Tournament& tournament, const TournamentLabels& labels,
                 const TournamentExtras& extras);

}  // namespace folk::tools
