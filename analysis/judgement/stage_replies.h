#pragma once
// Is each move a best reply to the belief that was stated before it, for that one round?

#include <folk/analysis/judgement/recorded_play.h>
#include <folk/games/payoffs.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace folk {

/// The moves of the rounds with a stated belief, each against the stage game's expected payoffs at that belief. What
/// the move makes the opponent do later does not count here: in a dilemma D is the best reply to every belief.
struct StageReplies {
  std::uint64_t rounds = 0;  ///< with a stated belief
  std::uint64_t best = 0;    ///< in which the move was a best reply to it; where both moves are, each is
  double loss_sum = 0;       ///< by how much less the moves were expected to earn than best replies
  double largest_loss = 0;
};

/// Beliefs are taken as the decimals that were written, so that ties are ties.
StageReplies stage_replies(const std::vector<RecordedMatch>& matches, const Payoffs& payoffs);

}  // namespace folk
