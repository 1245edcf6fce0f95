#pragma once
// `ipd-strategies champion`: the member of a class that earns most against all of them.

#include <folk/tools/program/program.h>

#include <folk/games/payoffs.h>

namespace folk::tools {

/// Adds the options of champion: class, evaluations, most-kinds, seed.
void add_champion_options(po::options_description& options);

/// Answers `ipd-strategies champion --class "memory(X,Y)"` on stdout.
int champion(const Payoffs& payoffs, const po::variables_map& values, const Common& common);

}  // namespace folk::tools
