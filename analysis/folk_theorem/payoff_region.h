#pragma once
// Which payoffs a round a repeated game can have, and which of them respect what each player can secure, all exact.

#include <folk/analysis/folk_theorem/convex_polygon.h>
#include <folk/games/stage_game.h>
#include <folk/games/stage_games/minmax.h>

#include <array>
#include <cstddef>

namespace folk {

/// Games with more actions of either seat are refused: exact minmax values would take minutes.
inline constexpr std::size_t most_region_actions = 40;

/// The payoff pairs of the folk theorem (Fudenberg & Maskin 1986).
struct PayoffRegion {
  Polygon<Rational> feasible;    ///< convex hull of the stage game's payoff pairs
  std::array<Minmax, 2> minmax;  ///< by seat
  /// Feasible pairs that pay each seat at least its mixed minmax value; never empty.
  Polygon<Rational> individually_rational;
  /// The same with the pure minmax values, which players who cannot hide their mixtures are held to; may be empty.
  Polygon<Rational> pure_individually_rational;

  Point<Rational> mixed_minmax() const { return {minmax[0].mixed, minmax[1].mixed}; }
  Point<Rational> pure_minmax() const { return {minmax[0].pure, minmax[1].pure}; }
};

/// Throws UsageError on a game of more than most_region_actions actions of a seat.
PayoffRegion payoff_region(const StageGame& game);

/// The stage game's payoff pairs, row by row.
std::vector<Point<Rational>> payoff_pairs(const StageGame& game);

/// Throws UsageError as payoff_region does, before anything is computed.
void require_small_for_region(const StageGame& game);

}  // namespace folk
