#pragma once
// Whom the evaluations play that training never meets.

#include <folk/tools/sct_train/config.h>

#include <folk/strategies/registry.h>
#include <folk/strategies/strategy.h>

#include <set>
#include <string>
#include <vector>

namespace folk::tools {

/// The strategies of config.held_out; none where it holds nobody out. `met`: the names of those that training meets.
/// Throws UsageError when one of them is held out too, by its name or by the play of its machine (equivalence.h): what
/// is earned against it would be called held out and is not.
std::vector<Strategy> held_out_roster(const TrainConfig& config, const Registry& names,
                                      const std::set<std::string>& met);

}  // namespace folk::tools
