#pragma once
// What a population is driven by: a tournament played on the spot, or one from a file.

#include <folk/tools/program/program.h>

#include <folk/analysis/evolution/score_matrix.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace folk::tools {

/// Scores, and what the output says of them.
struct PlayedScores {
  std::shared_ptr<const ScoreMatrix> scores;
  std::string roster;                                        ///< "classics, with pavlov", or the file
  std::string line;                                          ///< what was played, for the eye
  std::vector<std::pair<std::string, std::string>> members;  ///< the same for JSON: names and values as JSON
  std::vector<std::string> caveats;
};

/// Adds --strategies, --include, --exclude, those that say what is played, and --tournament.
void add_score_options(po::options_description& options);

/// Plays the roster, or reads the file of --tournament. Throws UsageError, InputFileError, and what players throw.
PlayedScores chosen_scores(const po::variables_map& values, const Common& common, std::uint64_t seed, unsigned threads);

/// A text as JSON has it.
std::string json_text(const std::string& text);

}  // namespace folk::tools
