#pragma once
// What a population is driven by: the scores of a tournament, and what the output says of them.

#include <folk/analysis/evolution/score_matrix.h>
#include <folk/analysis/pictures/caption.h>

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
  Caption caption{};  ///< of pictures
};

}  // namespace folk::tools
