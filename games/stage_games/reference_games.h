#pragma once
// Stage games whose equilibria and minmax values are known, for every test that needs a right answer.

#include <folk/games/stage_game.h>
#include <folk/games/stage_games/minmax.h>
#include <folk/games/stage_games/mixed_profile.h>

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace folk {

/// A stage game and what is known of it, all exact.
struct ReferenceGame {
  std::string name;                      ///< "stag_hunt"
  StageGame game;                        ///< the first action of the 2x2 games is the cooperative one
  std::string source;                    ///< where the game and its payoffs are from
  std::vector<MixedProfile> equilibria;  ///< all Nash equilibria of the stage game, pure ones first
  std::array<Minmax, 2> minmax;          ///< by seat

  const Minmax& minmax_of(Seat seat) const { return minmax[index(seat)]; }
};

/// prisoners_dilemma, stag_hunt, chicken, battle_of_the_sexes, matching_pennies, harmony, deadlock, abreu_sannikov.
const std::vector<ReferenceGame>& reference_games();

/// The one of this name. Throws UsageError with all names when there is none.
const ReferenceGame& reference_game(std::string_view name);

}  // namespace folk
