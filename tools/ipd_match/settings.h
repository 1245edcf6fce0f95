#pragma once
// What match is played, out of the options.

#include <folk/tools/ipd_match/record.h>
#include <folk/tools/program/program.h>

namespace folk::tools {

/// The two players of `player`, and what --rounds, --noise, --seed and the options of games and policies say. Throws
/// UsageError, InputFileError.
MatchSettings chosen_match(const po::variables_map& values);

}  // namespace folk::tools
