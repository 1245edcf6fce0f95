#pragma once
// The payoffs of all pure-strategy subgame-perfect equilibria of a discounted repeated game with public randomisation.

#include <folk/analysis/folk_theorem/convex_polygon.h>
#include <folk/games/stage_game.h>

#include <cstddef>

namespace folk {

/// The set for one discount factor, payoffs normalised by 1-d.
struct EquilibriumSet {
  double discount = 0;
  Polygon<double> corners;  ///< none: there is no pure-strategy subgame-perfect equilibrium
  Point<double> worst{};    ///< the least payoff of each seat over the set: the threat; 0 when there is none
  std::size_t steps = 0;    ///< how often the operator was applied
  double change = 0;        ///< how far its last application moved the set, as a share of the payoffs' range
};

/// A constraint that is missed by less than this share of the payoffs' range, over 1-d, counts as met, so that a
/// discount factor at which an incentive just binds is not lost to rounding.
inline constexpr double incentive_slack = 1e-13;

/// Abreu & Sannikov (2014), An algorithm for two-player repeated games with perfect monitoring, Theoretical Economics
/// 9, 313-338: from the feasible set W and the pure minmax point u on, W becomes the hull over the profiles a of
/// (1-d) g(a) + d C(a, W, u), and u the least payoffs in it, until nothing changes. C(a, W, u) is the pair g(a) itself
/// where playing a for ever deters deviations that are answered by u, otherwise the at most four ends of the two lines
/// in W on which one seat's incentive binds and the other's holds.
/// In doubles: the corners of W move by at most 1e-12 (1-d) of the payoffs' range, or 1e-14 where that is more, in the
/// last step. W shrinks at least as d^steps does.
/// Throws UsageError on a discount factor outside (0, 1), on a game too large (require_small_for_region), and when the
/// set still changes after most_equilibrium_steps, as it may for d very close to 1.
EquilibriumSet pure_equilibrium_set(const StageGame& game, double discount);

inline constexpr std::size_t most_equilibrium_steps = 1'000'000;

}  // namespace folk
