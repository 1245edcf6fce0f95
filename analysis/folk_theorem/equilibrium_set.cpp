#include <folk/analysis/folk_theorem/equilibrium_set.h>
#include <folk/analysis/folk_theorem/payoff_region.h>
#include <folk/games/criterion.h>
#include <folk/games/error.h>

#include <fmt/format.h>

#include <cmath>
#include <optional>

namespace folk {
namespace {

using Pair = Point<double>;
using Pairs = std::vector<Pair>;

/// A profile of actions, in units in which each seat's payoffs lie in [0, 1].
struct Profile {
  Pair payoff;     // g(a)
  Pair incentive;  // how far above the threat the continuation must be: (1-d)/d times the best deviation's gain
};

/// Payoffs of one seat in units of a power of two, from its least on: for most games nothing is rounded.
struct Unit {
  Rational least;
  Rational size;

  double of(const Rational& payoff) const { return to_double((payoff - least) / size); }
  double back(double value) const { return to_double(least) + to_double(size) * value; }
};

Unit unit_of(const StageGame& game, Seat seat) {
  const std::size_t axis = index(seat);
  const auto pairs = payoff_pairs(game);
  const auto [least, most] =
      std::minmax_element(pairs.begin(), pairs.end(), [&](const auto& a, const auto& b) { return a[axis] < b[axis]; });
  const Rational range = (*most)[axis] - (*least)[axis];
  if (range == 0) return {(*least)[axis], 1};
  if (!std::isfinite(to_double(range)) || !std::isfinite(to_double((*least)[axis])))
    throw UsageError("payoffs beyond 1e308 are too large for an equilibrium set: measure them in a larger unit");
  Rational size = 1;
  while (size < range) size *= 2;
  while (size / 2 >= range) size /= 2;
  return {(*least)[axis], size};
}

/// Every profile with what it asks of the continuation.
std::vector<Profile> profiles_of(const StageGame& game, const std::array<Unit, 2>& units, double discount) {
  std::vector<Rational> best_in_column(game.columns());
  std::vector<Rational> best_in_row(game.rows());
  for (std::size_t i = 0; i < game.rows(); ++i)
    for (std::size_t j = 0; j < game.columns(); ++j) {
      const Rational& row = game.payoff(Seat::first, i, j);
      const Rational& column = game.payoff(Seat::second, i, j);
      if (i == 0 || row > best_in_column[j]) best_in_column[j] = row;
      if (j == 0 || column > best_in_row[i]) best_in_row[i] = column;
    }
  const double weight = (1 - discount) / discount;
  std::vector<Profile> profiles;
  for (std::size_t i = 0; i < game.rows(); ++i)
    for (std::size_t j = 0; j < game.columns(); ++j) {
      const Rational& row = game.payoff(Seat::first, i, j);
      const Rational& column = game.payoff(Seat::second, i, j);
      profiles.push_back({{units[0].of(row), units[1].of(column)},
                          {weight * to_double((best_in_column[j] - row) / units[0].size),
                           weight * to_double((best_in_row[i] - column) / units[1].size)}});
    }
  return profiles;
}

/// The least and the most of the other coordinate where coordinate `axis` of a polygon is `at`, give or take `slack`.
std::optional<Pair> slice(const Polygon<double>& polygon, std::size_t axis, double at, double slack) {
  Pair range{INFINITY, -INFINITY};
  const auto include = [&range](double value) { range = {std::min(range[0], value), std::max(range[1], value)}; };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Pair& from = polygon[i];
    const Pair& to = polygon[(i + 1) % polygon.size()];
    if (std::abs(from[axis] - at) <= slack) include(from[1 - axis]);
    if ((from[axis] < at) == (to[axis] < at)) continue;
    const double share = (at - from[axis]) / (to[axis] - from[axis]);
    include(from[1 - axis] + share * (to[1 - axis] - from[1 - axis]));
  }
  if (range[0] > range[1]) return std::nullopt;
  return range;
}

/// C(a, W, u).
Pairs continuations(const Profile& profile, const Polygon<double>& set, const Pair& threat, double slack) {
  const Pair least{threat[0] + profile.incentive[0], threat[1] + profile.incentive[1]};
  if (profile.payoff[0] >= least[0] - slack && profile.payoff[1] >= least[1] - slack) return {profile.payoff};
  Pairs ends;
  for (const std::size_t axis : {0U, 1U}) {
    const auto line = slice(set, axis, least[axis], slack);
    if (!line || (*line)[1] < least[1 - axis] - slack) continue;
    const double high = (*line)[1];
    for (const double end : {std::min(std::max((*line)[0], least[1 - axis]), high), high}) {
      Pair point;
      point[axis] = least[axis];
      point[1 - axis] = end;
      ends.push_back(point);
    }
  }
  return ends;
}

/// How far a point is from a polygon with at least one corner; 0 inside.
double distance(const Pair& point, const Polygon<double>& polygon) {
  bool inside = polygon.size() > 2;
  double least = INFINITY;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Pair& from = polygon[i];
    const Pair& to = polygon[(i + 1) % polygon.size()];
    inside = inside && turn(from, to, point) >= 0;
    const Pair edge{to[0] - from[0], to[1] - from[1]};
    const double length = edge[0] * edge[0] + edge[1] * edge[1];
    const double along = (point[0] - from[0]) * edge[0] + (point[1] - from[1]) * edge[1];
    const double share = length > 0 ? std::clamp(along / length, 0.0, 1.0) : 0.0;
    least = std::min(least, std::hypot(from[0] + share * edge[0] - point[0], from[1] + share * edge[1] - point[1]));
  }
  return inside ? 0 : least;
}

/// How far a set has moved: the larger of the distances of either's corners from the other.
double moved(const Polygon<double>& before, const Polygon<double>& after) {
  double most = 0;
  for (const Pair& corner : before) most = std::max(most, distance(corner, after));
  for (const Pair& corner : after) most = std::max(most, distance(corner, before));
  return most;
}

/// Corners that rounding made (closer than this to the line between their neighbours) are left out.
constexpr double same_corner = 1e-10;

Polygon<double> without_rounding(Polygon<double> polygon) {
  for (std::size_t i = 0; i < polygon.size() && polygon.size() > 1;) {
    const Pair& before = polygon[(i + polygon.size() - 1) % polygon.size()];
    const Pair& after = polygon[(i + 1) % polygon.size()];
    if (distance(polygon[i], {before, after}) > same_corner) {
      ++i;
    } else {
      polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(i));
      i = 0;
    }
  }
  return polygon;
}

/// The least of both coordinates.
Pair lowest(const Polygon<double>& polygon) {
  Pair least{INFINITY, INFINITY};
  for (const Pair& corner : polygon) least = {std::min(least[0], corner[0]), std::min(least[1], corner[1])};
  return least;
}

/// The operator R and what it is applied to, in units.
class Iteration {
public:
  Iteration(std::vector<Profile> profiles, const Pair& minmax, double discount)
      : profiles_(std::move(profiles)),
        minmax_(minmax),
        discount_(discount),
        slack_(incentive_slack / (1 - discount)),
        enough_(std::max(1e-12 * (1 - discount), 1e-14)) {
    Pairs pairs;
    for (const Profile& profile : profiles_) pairs.push_back(profile.payoff);
    set_ = convex_hull(std::move(pairs));
  }

  /// Applies R until the set stays, and counts.
  void run(EquilibriumSet& result) {
    do {
      if (result.steps == most_equilibrium_steps)
        throw UsageError(fmt::format(
            "discount factor {}: the set still moves by {:.2g} of the payoffs' range after {} steps: take one farther "
            "from 1",
            discount_, result.change, result.steps));
      Polygon<double> next = applied();
      ++result.steps;
      result.change = next.empty() ? 0 : moved(set_, next);
      set_ = std::move(next);
    } while (result.change > enough_);
  }

  const Polygon<double>& set() const { return set_; }

private:
  Polygon<double> applied() {
    const Pair least = lowest(set_);
    const Pair threat{std::max(minmax_[0], least[0]), std::max(minmax_[1], least[1])};
    Pairs points;
    // A profile that no continuation supports is not supported by a smaller set and a higher threat either.
    std::erase_if(profiles_, [&](const Profile& profile) {
      const Pairs ends = continuations(profile, set_, threat, slack_);
      for (const Pair& end : ends)
        points.push_back({end[0] + (1 - discount_) * (profile.payoff[0] - end[0]),
                          end[1] + (1 - discount_) * (profile.payoff[1] - end[1])});
      return ends.empty();
    });
    return convex_hull(std::move(points));
  }

  std::vector<Profile> profiles_;
  Pair minmax_;
  double discount_;
  double slack_;
  double enough_;
  Polygon<double> set_;
};

}  // namespace

EquilibriumSet pure_equilibrium_set(const StageGame& game, double discount) {
  require_small_for_region(game);
  EquilibriumSet result;
  result.discount = Criterion::discounted(discount).continuation();
  const std::array<Unit, 2> units{unit_of(game, Seat::first), unit_of(game, Seat::second)};
  const Pair minmax{units[0].of(pure_minmax(game, Seat::first)), units[1].of(pure_minmax(game, Seat::second))};
  Iteration iteration(profiles_of(game, units, discount), minmax, discount);
  iteration.run(result);
  for (const Pair& corner : without_rounding(iteration.set()))
    result.corners.push_back({units[0].back(corner[0]), units[1].back(corner[1])});
  if (!result.corners.empty()) result.worst = lowest(result.corners);
  return result;
}

}  // namespace folk
