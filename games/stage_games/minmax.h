#pragma once
// To how little an opponent can hold one seat of a stage game, exactly and with the proof.

#include <folk/games/stage_game.h>
#include <folk/games/stage_games/mixed_profile.h>

namespace folk {

/// To how little an opponent can hold one seat.
struct Minmax {
  Rational pure;           ///< when the opponent does not mix and the seat replies best
  Rational mixed;          ///< when the opponent may mix: min over their mixtures of max over own actions
  MixedAction punishment;  ///< a mixture of the opponent that holds the seat to `mixed`
  MixedAction security;    ///< a mixture of the seat's own that guarantees it `mixed`: with `punishment`, the proof
};

/// Both values of `seat`: the mixed one is the value of the zero-sum game about its payoffs (von Neumann 1928), solved
/// as a linear programme in rationals (Dantzig 1951) whose two solutions are checked before they are returned. Either
/// mixture is a pure action where one serves.
Minmax minmax(const StageGame& game, Seat seat);

/// The most that `seat` gets against this mixture of the opponent.
/// Throws UsageError when it is no mixed action of the other seat.
Rational most_against(const StageGame& game, Seat seat, const MixedAction& opponent);

/// The least that this mixture of `seat`'s own guarantees it.
/// Throws UsageError when it is no mixed action of the seat.
Rational guaranteed(const StageGame& game, Seat seat, const MixedAction& own);

}  // namespace folk
