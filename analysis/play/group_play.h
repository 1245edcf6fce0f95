#pragma once
// Many contests played side by side, so that players that think expensively can think together.

#include <folk/analysis/play/played_match.h>
#include <folk/games/progress.h>

#include <vector>

namespace folk {

/// Matches that are on at the same time.
inline constexpr std::size_t most_matches_at_once = 256;

/// Plays each contest `sampling.repetitions` times, or once, and returns their results in the same order.
///
/// Matches whose players are machines or think together are played side by side, up to most_matches_at_once of them:
/// before each round all players of one strategy (both seats of self-play among them) are told to think together. A
/// contest with any other opaque player is played one match at a time by the same two players, and so is one in which
/// nobody thinks together. The results depend on neither.
///
/// Method::sampled; for a contest played once Method::played, and Method::bounded under mean, of which long_run_rounds
/// prove no limit. `progress` is told the finished share, 0 to 1.
/// Throws UsageError when a contest takes more than 10^8 rounds, Cancelled, and what the players throw.
std::vector<PairResult> play_group(const std::vector<Contest>& contests, const Sampling& sampling,
                                   const Progress& progress = nullptr);

}  // namespace folk
