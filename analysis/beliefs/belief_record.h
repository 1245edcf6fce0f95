#pragma once
// Matches of one policy round by round: what it did, what it believed, and what the opponent truly was about to do.

#include <folk/analysis/play/sampling.h>
#include <folk/games/outcome.h>
#include <folk/games/progress.h>
#include <folk/strategies/strategy.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace folk {

/// One round as the policy met it.
struct BeliefRound : Outcome {
  std::optional<double> belief{};  ///< P(their C) as the policy held it; nothing from a policy without beliefs
  double truth = 1;  ///< P(their C) in the state of an opponent that is a machine; else 1 or 0 by the move it played

  bool operator==(const BeliefRound&) const = default;
};

/// A match from its first round on.
using BeliefMatch = std::vector<BeliefRound>;

/// All matches of the policy against one opponent.
struct BeliefRecord {
  std::string opponent;
  bool once = false;  ///< both sides are deterministic: the one match is the whole path
  std::vector<BeliefMatch> matches;
};

/// Rounds that may be recorded in one call, over all opponents and repetitions.
inline constexpr std::uint64_t most_recorded_rounds = 20'000'000;

/// True for a machine that mixes in no state and for an opaque player that says so.
bool is_deterministic(const Strategy& strategy);

/// Plays `policy` against each of `opponents` under sampling.criterion, which must be finite:T, and returns the records
/// in the order of the opponents. A pair of which nobody draws random numbers plays one match, any other
/// sampling.repetitions of them: match r against opponent i draws from match_key(seed, i, r, role), the policy in the
/// first seat.
///
/// Matches are played as play_side_by_side does; `progress` is told the finished share, 0 to 1.
/// Throws UsageError for another criterion, for noise (a slip is no belief about the opponent) and for more than
/// most_recorded_rounds, Cancelled, and what the players throw.
std::vector<BeliefRecord> record_beliefs(const Strategy& policy, const std::vector<Strategy>& opponents,
                                         const Sampling& sampling, const Progress& progress = nullptr);

}  // namespace folk
