#pragma once
// A named entrant of a tournament.

#include <folk/strategies/machine.h>
#include <folk/strategies/player.h>

#include <functional>
#include <memory>
#include <string>

namespace folk {

/// A name and how to play it: a machine where it is one, else only a maker of opaque players.
struct Strategy {
  std::string name;
  std::shared_ptr<const Machine> machine;                ///< null for an opaque player
  std::function<std::unique_ptr<Player>()> make_player;  ///< set for an opaque player

  /// An opaque player that draws no random numbers: against another deterministic one, without noise, one match is all
  /// there is.
  bool deterministic = false;
  /// Its opaque players gain from Player::think_together: hundreds of them are kept at once and asked round by round.
  bool thinks_together = false;
  /// Rounds whose expected payoff on its own beliefs its moves maximise (planned_belief_gap.h); 0: it does not say so.
  unsigned plans_ahead = 0;
  /// Makes players with the same beliefs after every history that spend less on their moves; empty: there are none.
  std::function<std::unique_ptr<Player>()> make_believer{};
  /// It stands in the roster as one of a roster or family that was named: where two of them overlap it enters once.
  bool of_family = false;
  /// What a reader must know of its figures, e.g. "sct extrapolates beyond its 100 trained rounds"; empty: nothing.
  std::string caveat{};

  /// A fresh player of this strategy.
  std::unique_ptr<Player> new_player() const { return machine ? play(machine) : make_player(); }
};

}  // namespace folk
