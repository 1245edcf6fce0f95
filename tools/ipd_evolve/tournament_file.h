#pragma once
// A finished tournament out of a file of ipd-tournament.

#include <folk/tools/ipd_evolve/played_scores.h>

#include <string>

namespace folk::tools {

/// Reads what `ipd-tournament --format json` prints, or a table of scores as its scores.csv (of which the weight of a
/// match is not known: a score counts as a payoff). Throws InputFileError.
PlayedScores read_tournament_file(const std::string& file);

}  // namespace folk::tools
