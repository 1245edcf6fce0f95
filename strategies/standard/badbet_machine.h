#pragma once
// badbet: bets on whichever of four strategies has just paid most.

#include <folk/strategies/machine.h>

namespace folk {

/// A meta strategy over tit_for_tat, all_c, spiteful and per_ccd: plays each 4 rounds in turn; from then on, every 4
/// rounds, picks the one with the highest score since it was last picked (first of equals), sets that score to 0 and
/// plays it 4 rounds. Each sees only the rounds it played. Scores count 5, 3, 1, 0 whatever the game.
class BadbetMachine final : public Machine {
public:
  /// When its spiteful defects.
  enum class Spite {
    for_ever,       ///< once either side has played D
    of_last_round,  ///< when either has in the last round that it played: the program of Mathieu & Delahaye
  };

  explicit BadbetMachine(Spite spite)
      : spite_(spite) {}

  State start() const override;
  double cooperation(State state) const override;
  State next(State state, Move own, Move theirs) const override;

private:
  Spite spite_;
};

}  // namespace folk
