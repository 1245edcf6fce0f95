#pragma once
// Convex sets of payoff pairs by their corners, for exact numbers and for doubles.

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace folk {

/// The row seat's payoff, then the column seat's.
template <class Number>
using Point = std::array<Number, 2>;

/// Corners counterclockwise, the leftmost (of those the lowest) first, no three on a line. One corner: a point; two: a
/// segment; none: the empty set.
template <class Number>
using Polygon = std::vector<Point<Number>>;

/// Twice the area of the triangle a, b, c, positive when it is counterclockwise.
template <class Number>
Number turn(const Point<Number>& a, const Point<Number>& b, const Point<Number>& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// The convex hull of any points (Andrew 1979).
template <class Number>
Polygon<Number> convex_hull(std::vector<Point<Number>> points) {
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  Polygon<Number> hull;
  const auto add = [&hull](const Point<Number>& point, std::size_t kept) {
    while (hull.size() > kept && !(turn(hull[hull.size() - 2], hull.back(), point) > 0)) hull.pop_back();
    hull.push_back(point);
  };
  for (const auto& point : points) add(point, 1);
  const std::size_t lower = hull.size();
  for (auto point = points.rbegin() + 1; point != points.rend(); ++point) add(*point, lower);
  hull.pop_back();
  return hull;
}

/// The part of a polygon where coordinate `axis` is at least `least`.
template <class Number>
Polygon<Number> clipped(const Polygon<Number>& polygon, std::size_t axis, const Number& least) {
  std::vector<Point<Number>> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const auto& from = polygon[i];
    const auto& to = polygon[(i + 1) % polygon.size()];
    if (!(from[axis] < least)) kept.push_back(from);
    if ((from[axis] < least) == (to[axis] < least)) continue;
    const Number share = (least - from[axis]) / (to[axis] - from[axis]);
    Point<Number> cut;
    cut[axis] = least;
    cut[1 - axis] = from[1 - axis] + share * (to[1 - axis] - from[1 - axis]);
    kept.push_back(std::move(cut));
  }
  return convex_hull(std::move(kept));
}

}  // namespace folk
