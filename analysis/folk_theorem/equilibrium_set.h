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

/// A discount factor stands for the fraction of the least denominator that is above it by at most this share of d or
/// 1-d, whichever is less, so that one at which an incentive just binds is not lost to the rounding of its decimals:
/// 0.14285714285714 is 1/7. (10^-13.)
const Rational& discount_tolerance();

inline constexpr std::size_t plain_steps = 100;
inline constexpr std::size_t most_equilibrium_steps = 10'000;

/// Abreu & Sannikov (2014), An algorithm for two-player repeated games with perfect monitoring, Theoretical Economics
/// 9, 313-338: from the feasible set W and the pure minmax point u on, W becomes the hull over the profiles a of
/// (1-d) g(a) + d C(a, W, u), and u the least payoffs in it, until nothing changes. C(a, W, u) is the pair g(a) itself
/// where playing a for ever deters deviations that are answered by u, otherwise the at most four ends of the two lines
/// in W on which one seat's incentive binds and the other's holds.
/// In numbers of 154 digits: the corners of W move by at most 1e-12 (1-d) of the payoffs' range in the last step (where
/// payoffs differ by less than a thousandth of the range, by that much less). After plain_steps, what the steps would
/// take away slowly is cut off at once (EquilibriumIteration::tighten), so that a d next to 1 takes no longer.
/// Throws UsageError on a discount factor outside (0, 1) and on a game too large (require_small_for_region);
/// UndecidedError when the set still changes after most_steps, or the payoffs of a seat, measured in their
/// range, have a common denominator beyond 2^200.
EquilibriumSet pure_equilibrium_set(const StageGame& game, const Rational& discount,
                                    std::size_t most_steps = most_equilibrium_steps);

/// The same of the shortest decimal that is this double.
EquilibriumSet pure_equilibrium_set(const StageGame& game, double discount,
                                    std::size_t most_steps = most_equilibrium_steps);

}  // namespace folk
