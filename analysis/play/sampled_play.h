#pragma once
// What cannot be solved is played: the mean of repetitions, with its standard error.

#include <folk/analysis/play/pair_result.h>
#include <folk/analysis/play/sampling.h>
#include <folk/analysis/play/side_by_side.h>
#include <folk/games/progress.h>

#include <vector>

namespace folk {

/// Plays each contest as play_side_by_side does and returns the means of their matches in the same order.
///
/// Method::sampled; for a contest played once Method::played, and Method::bounded under mean, of which long_run_rounds
/// prove no limit. `progress` is told the finished share, 0 to 1.
/// Throws UsageError when a contest takes more than 10^8 rounds, Cancelled, and what the players throw.
std::vector<PairResult> play_sampled(const std::vector<Contest>& contests, const Sampling& sampling,
                                     const Progress& progress = nullptr);

}  // namespace folk
