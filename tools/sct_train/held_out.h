#pragma once
// Whom the evaluations play that training never meets.

#include <folk/tools/sct_train/config.h>

#include <folk/strategies/registry.h>
#include <folk/strategies/strategy.h>

#include <set>
#include <string>
#include <vector>

namespace folk::tools {

/// Whom training meets: the roster, or the opponents that a folder names, whose machines are known where `names` knows
/// them.
std::vector<Strategy> met_in_training(const TrainConfig& config, const std::vector<Strategy>& roster,
                                      const std::set<std::string>& opponents, const Registry& names);

/// The strategies of config.held_out; none where it holds nobody out. Throws UsageError when it holds out one of `met`,
/// by its name or by the play of its machine (equivalence.h): what is earned against it would be called held out and
/// is not.
std::vector<Strategy> held_out_roster(const TrainConfig& config, const std::vector<Strategy>& met,
                                      const Registry& names);

}  // namespace folk::tools
