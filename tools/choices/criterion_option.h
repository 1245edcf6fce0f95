#pragma once
// The options that say how the payoffs of a match add up: --rounds, --criterion, --end-probability.

#include <folk/tools/program/program.h>

#include <folk/games/criterion.h>

namespace folk::tools {

/// Adds --rounds, --criterion and --end-probability.
void add_criterion_options(po::options_description& options);

/// What they say; finite:100 by default. Throws UsageError when two of them differ.
Criterion chosen_criterion(const po::variables_map& values);

}  // namespace folk::tools
