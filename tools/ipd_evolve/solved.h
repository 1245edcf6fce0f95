#pragma once
// The answers of --fixation and --stationary.

#include <folk/tools/ipd_evolve/fixation_output.h>

#include <folk/games/progress.h>

#include <cstdint>

namespace folk::tools {

/// Throws UsageError, and Cancelled.
FixationReport solved(const PlayedScores& played, const EvolveQuestion& question, std::uint64_t seed, unsigned threads,
                      const Progress& progress);

}  // namespace folk::tools
