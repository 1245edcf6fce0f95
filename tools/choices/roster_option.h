#pragma once
// The options that say who takes part: --strategies, --include and --exclude.

#include <folk/tools/program/program.h>

#include <folk/games/payoffs.h>
#include <folk/strategies/strategy.h>

#include <cstddef>
#include <vector>

namespace folk::tools {

/// The roster less what is excluded; the included entrants follow it.
struct Field {
  std::vector<Strategy> entrants;
  std::size_t core = 0;
};

/// What --strategies, --include and --exclude (which a program adds, each with its own words) and the play options say.
/// Throws UsageError, and what strategies throw that are read from files.
Field chosen_field(const po::variables_map& values, const Payoffs& payoffs);

}  // namespace folk::tools
