#pragma once
// The algorithm of Abreu & Sannikov (2014) step by step, and shortcuts for where its steps are small.

#include <folk/analysis/folk_theorem/convex_polygon.h>
#include <folk/analysis/folk_theorem/precise.h>

#include <optional>
#include <vector>

namespace folk {

/// A profile of actions a, in units in which each seat's payoffs lie in [0, 1].
struct RepeatedProfile {
  Point<Precise> payoff;     ///< g(a)
  Point<Precise> deviation;  ///< what the best deviation from a pays each seat
};

/// Sets that shrink to that of all equilibrium payoffs, V, and threats that rise to the least payoffs in V. At every
/// moment V lies in set() and pays each seat at least threat().
class EquilibriumIteration {
public:
  /// From the feasible set and `minmax` on.
  EquilibriumIteration(std::vector<RepeatedProfile> profiles, const Point<Precise>& minmax, const Rational& discount);

  /// Applies the operator R once and tells how far the set moved: the farthest corner of either set from the other.
  Precise step();

  /// Cuts off what no equilibrium pays though R takes it away in small steps only, in some 1/(1-d) of them.
  ///
  /// Let c be the most of normal . v over V, attained at v = (1-d) g(a) + d w. As normal . w <= c, normal . g(a) >= c;
  /// and w lies in Q(a), the part of the set that deters deviations from a. So c is at most the largest
  /// (1-d) normal . g(a) + d min(normal . g(a), max normal . Q(a)) over the profiles whose normal . g(a) is not less
  /// than min normal . Q(a). In the same way, the least payoff of a seat in V is at least dev(a) for the a that gives
  /// it, and not only (1-d) dev(a) + d times the threat.
  void tighten();

  const Polygon<Precise>& set() const { return set_; }

private:
  struct Supported;

  Point<Precise> least_continuation(const RepeatedProfile& profile) const;
  void raise_threat();
  std::vector<Supported> supported();
  void tighten_threat(const std::vector<Supported>& profiles);
  void shift_edges(const std::vector<Supported>& profiles);
  /// Edges turned about one of their ends, as far as a line through a point that might be paid.
  void turn_edges(const std::vector<Supported>& profiles);
  void turn_edge(const std::vector<Supported>& profiles, const std::vector<Point<Precise>>& through,
                 const Point<Precise>& pivot, const Point<Precise>& turned);
  /// What normal . v is at most for a v of V that begins with this profile; nothing where none does.
  std::optional<Precise> most_paid(const Supported& profile, const Point<Precise>& normal, const Precise& own) const;
  std::optional<Precise> bound(const std::vector<Supported>& profiles, const Point<Precise>& normal) const;
  bool pays_more(const std::vector<Supported>& profiles, const Point<Precise>& normal, const Precise& limit) const;

  std::vector<RepeatedProfile> profiles_;
  Point<Precise> threat_;
  Precise patience_;  // 1-d
  Precise weight_;    // (1-d)/d
  Polygon<Precise> set_;
  bool tightened_ = false;
};

/// Without the corners that are at most `tolerance` away from the line between their neighbours, but for those that
/// alone pay a seat the least.
Polygon<Precise> without_blunt_corners(Polygon<Precise> polygon, const Precise& tolerance);

/// The least of both coordinates of a polygon that is not empty.
Point<Precise> lowest(const Polygon<Precise>& polygon);

}  // namespace folk
