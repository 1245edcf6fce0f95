#pragma once
// Is a planner's play a best reply to its own beliefs, as far as it looks ahead? The third self-confirming notion for
// who weighs what it holds possible.

#include <folk/analysis/beliefs/own_belief_gap.h>

namespace folk {

/// How far planned_belief_gaps looks.
struct PlannedSearch {
  Payoffs payoffs{};
  unsigned threads = 1;
  std::size_t depth = 4;            ///< h: rounds, 1 to most_planned_depth
  double least_probability = 0.01;  ///< a believed move less likely than this is taken to lead where the likelier does
  std::vector<std::uint64_t> rounds{};  ///< of the path, 1-based; empty: all
};

inline constexpr std::size_t most_planned_depth = 10;

/// Notion (c) by its definition: in round t of a path the player stands in the true history; the other moves as the
/// player believes it to, with those probabilities, after every play of the next h rounds (fewer at the end of
/// finite:T, T being the length of the paths). The gain of a round is what the better move is expected to earn in these
/// rounds more than the one that was made, the best being played after both; the largest of the path is told, in its
/// unit, with the better move and the belief of that round as the witness. Gains that are no more than what beliefs are
/// rounded to (10^-4 of the value) count 0.
///
/// Beliefs are asked of players of Strategy::make_believer where there are some, one for each history: the search
/// shares nothing with the player's own. Nothing for a player that draws random numbers or holds no beliefs. Throws
/// UsageError for paths of different lengths, a depth or round out of range, Cancelled, and what the players throw.
std::vector<std::optional<OwnBeliefGap>> planned_belief_gaps(const Strategy& player,
                                                             const std::vector<BeliefMatch>& paths,
                                                             const PlannedSearch& search,
                                                             const Progress& progress = nullptr);

}  // namespace folk
