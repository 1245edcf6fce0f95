#pragma once
// The options that say what a population is driven by: a roster that plays on the spot, or --tournament.

#include <folk/tools/ipd_evolve/played_scores.h>
#include <folk/tools/program/program.h>

#include <folk/games/progress.h>

#include <cstdint>

namespace folk::tools {

/// Adds --strategies, --include, --exclude, those that say what is played, and --tournament.
void add_score_options(po::options_description& options);

/// Plays the roster, or reads the file of --tournament. Throws UsageError, InputFileError, Cancelled, and what players
/// throw.
PlayedScores chosen_scores(const po::variables_map& values, const Common& common, std::uint64_t seed, unsigned threads,
                           const Progress& progress);

}  // namespace folk::tools
