#pragma once
// How a tournament is played, out of the options.

#include <folk/tools/program/program.h>

#include <folk/analysis/tournament/tournament.h>

namespace folk::tools {

/// What --rounds, --criterion, --noise, --no-self-play, --repetitions, --seed and --threads say. Throws UsageError.
TournamentSettings chosen_settings(const po::variables_map& values, const Common& common, const Payoffs& payoffs);

}  // namespace folk::tools
