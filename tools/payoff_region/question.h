#pragma once
// What is asked about a game's payoffs, out of the options, and the answer.

#include <folk/tools/payoff_region/output.h>
#include <folk/tools/program/program.h>

#include <folk/games/progress.h>

namespace folk::tools {

/// The region of --game or --payoffs, the equilibria of --discount, the pairs of the tournament of --strategies, whose
/// play `progress` is told. Throws UsageError, InputFileError, Cancelled, and what players throw.
RegionReport region_report(const po::variables_map& values, const Common& common, const Progress& progress);

}  // namespace folk::tools
