#pragma once
// Mixed actions of a stage game, what they pay and whether they are an equilibrium, all exact.

#include <folk/games/stage_game.h>

#include <cstddef>
#include <vector>

namespace folk {

/// The probability of each action of one seat; they add up to 1.
using MixedAction = std::vector<Rational>;

/// One mixed action for each seat.
struct MixedProfile {
  MixedAction row;
  MixedAction column;

  const MixedAction& of(Seat seat) const { return seat == Seat::first ? row : column; }

  bool operator==(const MixedProfile&) const = default;
};

/// `action` with probability 1 out of `actions`. Throws UsageError when there is no such action.
MixedAction pure_action(std::size_t actions, std::size_t action);

/// What each action of `seat` pays it on average when the other seat plays `opponent`.
/// Throws UsageError when `opponent` is no mixed action of the other seat.
std::vector<Rational> action_payoffs(const StageGame& game, Seat seat, const MixedAction& opponent);

/// What the profile pays `seat` on average. Throws UsageError when the profile is none of this game.
Rational expected_payoff(const StageGame& game, Seat seat, const MixedProfile& profile);

/// The most that `seat` gains by deviating alone, 0 or more (its regret). Throws UsageError as expected_payoff.
Rational largest_gain(const StageGame& game, Seat seat, const MixedProfile& profile);

/// True when neither seat gains by deviating (Nash 1951). Throws UsageError as expected_payoff.
bool is_equilibrium(const StageGame& game, const MixedProfile& profile);

/// The least payoff to which an opponent who does not mix can hold `seat`, who replies best:
/// min over their actions of max over own actions.
Rational pure_minmax(const StageGame& game, Seat seat);

}  // namespace folk
