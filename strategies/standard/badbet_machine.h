#pragma once
// badbet: bets on whichever of four strategies has just paid most.

#include <folk/strategies/machine.h>

namespace folk {

/// A meta strategy over tit_for_tat, all_c, spiteful and per_ccd: plays each 4 rounds in turn; from then on, every 4
/// rounds, picks the one with the highest score since it was last picked (first of equals), sets that score to 0 and
/// plays it 4 rounds. Each sees only the rounds it played. Scores count 5, 3, 1, 0 whatever the game.
class BadbetMachine final : public Machine {
public:
  State start() const override;
  double cooperation(State state) const override;
  State next(State state, Move own, Move theirs) const override;
};

}  // namespace folk
