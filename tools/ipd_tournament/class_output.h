#pragma once
// Complete classes as text, CSV and JSON: their own ranking, and how entrants do against them.

#include <folk/analysis/classes/behaviours.h>
#include <folk/analysis/classes/class_score.h>
#include <folk/analysis/classes/class_tournament.h>

#include <filesystem>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace folk::tools {

/// The text ranking shows so many members, CSV and JSON all.
inline constexpr std::size_t most_shown_members = 100;

/// What the output says beside the results.
struct ClassLabels {
  std::string game;  ///< its title
  std::string command{};
  std::optional<Behaviours> behaviours{};  ///< a ranking has a row a behaviour then, its first member standing for it
};

void write_class_text(std::ostream& out, const ClassTournament& tournament, const ClassLabels& labels);
void write_class_csv(std::ostream& out, const ClassTournament& tournament, const ClassLabels& labels);

/// One object: settings, class, ranking. `kept` in a file: Folk's version and the command line too, no ranking.
void write_class_json(std::ostream& out, const ClassTournament& tournament, const ClassLabels& labels, bool kept);

/// ranking.csv and summary.json in `folder`, each written whole or not at all.
void write_class_files(const std::filesystem::path& folder, const ClassTournament& tournament,
                       const ClassLabels& labels);

/// Entrants against a class, best first.
struct ClassScores {
  MemoryClass members;
  ClassScoreSettings settings;
  struct Entrant {
    std::string name;
    ClassScore score;
  };
  std::vector<Entrant> entrants{};
  std::vector<std::pair<std::string, std::string>> left_out{};  ///< names, and why they have no score
};

void write_scores_text(std::ostream& out, const ClassScores& scores, const ClassLabels& labels);
void write_scores_csv(std::ostream& out, const ClassScores& scores);
void write_scores_json(std::ostream& out, const ClassScores& scores, const ClassLabels& labels);

/// class.csv and summary.json in `folder`.
void write_scores_files(const std::filesystem::path& folder, const ClassScores& scores, const ClassLabels& labels);

}  // namespace folk::tools
