#pragma once
// How a policy fares with each target of a grid.

#include <folk/analysis/play/sampled_play.h>
#include <folk/games/progress.h>
#include <folk/sct/policy/policy.h>
#include <folk/sct/policy/roster_play.h>
#include <folk/sct/training/selection.h>
#include <folk/strategies/strategy.h>

#include <vector>

namespace folk::sct {

/// One policy against each of the roster, asked for each target in turn; `sampling` says game, rounds, noise,
/// repetitions, seed and threads. Throws Cancelled.
std::vector<TargetScore> validate(const Policy& policy, const std::vector<double>& targets,
                                  const std::vector<Strategy>& roster, const Sampling& sampling,
                                  const Progress& progress = nullptr);

/// The same against each of a held-out roster too, in matches of their own; an empty one is none.
std::vector<TargetScore> validate(const Policy& policy, const std::vector<double>& targets,
                                  const std::vector<Strategy>& roster, const std::vector<Strategy>& held_out,
                                  const Sampling& sampling, const Progress& progress = nullptr);

/// The policy with its own target.
RosterScore play_policy(const Policy& policy, const std::vector<Strategy>& roster, const Sampling& sampling,
                        const Progress& progress = nullptr);

}  // namespace folk::sct
