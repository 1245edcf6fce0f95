#pragma once
// All Nash equilibria of a small stage game, pure and mixed, exact.

#include <folk/games/stage_game.h>
#include <folk/games/stage_games/mixed_profile.h>

#include <cstddef>
#include <vector>

namespace folk {

/// Games with more actions (both seats' together) are refused: their polytopes may have too many vertices.
inline constexpr std::size_t most_equilibrium_actions = 20;

/// The equilibria of a stage game.
struct StageEquilibria {
  /// The extreme ones: no one of them is a mixture of others with the same best replies. Pure ones first, then in the
  /// order of the mixtures' probabilities. They are all there are unless the game is degenerate.
  std::vector<MixedProfile> extreme;
  /// Some mixture has more best replies than actions it mixes (von Stengel 2002). Then there may be infinitely many
  /// equilibria: each is a convex combination of extreme ones in whose set any row's mixture is an equilibrium with any
  /// column's.
  bool degenerate = false;
};

/// Enumerates the vertices of both best-reply polytopes and keeps the pairs in which every action is either not played
/// or a best reply (Mangasarian 1964; labels as in von Stengel 2002, Handbook of Game Theory 3, chapter 45). Each
/// equilibrium is verified by is_equilibrium before it is returned.
/// Throws UsageError on a game of more than most_equilibrium_actions actions.
StageEquilibria stage_equilibria(const StageGame& game);

/// True when each seat plays one action.
bool is_pure(const MixedProfile& profile);

}  // namespace folk
