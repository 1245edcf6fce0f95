#pragma once
// `ipd-strategies same`: which strategies of a SPEC are one under several names.

#include <folk/tools/program/program.h>

#include <folk/games/payoffs.h>
#include <folk/strategies/same_strategies.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace folk::tools {

/// Answers `ipd-strategies same SPEC` on stdout.
int same(const std::string& spec, Sense sense, std::size_t most_pairs, const Payoffs& payoffs, const Common& common);

/// The same as what --format json prints.
nlohmann::ordered_json same_json(const std::string& spec, const std::vector<Strategy>& strategies, Sense sense,
                                 const SameStrategies& found);

}  // namespace folk::tools
