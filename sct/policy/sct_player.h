#pragma once
// A self-confirming transformer as a player with beliefs.

#include <folk/sct/policy/thinker.h>
#include <folk/strategies/strategy.h>

#include <memory>
#include <optional>
#include <string>

namespace folk::sct {

/// How a policy is made to play.
struct PlayOptions {
  std::optional<double> target{};       ///< asked return of a match, unscaled; none: the policy's own
  bool sample = false;                  ///< draw actions from the policy instead of taking the likelier one
  bool extrapolate = false;             ///< play games, criteria and rounds it was not trained on
  std::optional<Move> forced_belief{};  ///< this is held for certain, whatever the network believes
  /// Rounds that it looks ahead: its moves are a best reply to its beliefs (planner.h), whatever its action head says.
  /// 0: the action head moves; none: as the policy says.
  std::optional<unsigned> plan_depth{};
};

/// The policy as an entrant. Its players share `mind`, and their thoughts about equal histories.
///
/// They throw UsageError when a match is not the game, or is longer than, it was trained for, unless `extrapolate`;
/// then the time table's last row stands for all later rounds, and the strategy's caveat says so. In a shorter match
/// the target is scaled down with the rounds.
Strategy transformer(std::string name, std::shared_ptr<const Mind> mind, const PlayOptions& options = {});

}  // namespace folk::sct
