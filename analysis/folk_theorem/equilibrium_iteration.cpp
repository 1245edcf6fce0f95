#include <folk/analysis/folk_theorem/equilibrium_iteration.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace folk {

struct EquilibriumIteration::Supported {
  Point<Precise> payoff;
  Point<Precise> deviation;
  Polygon<Precise> continuations;  // Q(a), not empty
};

namespace {

using Place = Point<Precise>;
using Places = std::vector<Place>;
using Shape = Polygon<Precise>;

Precise dot(const Place& a, const Place& b) { return a[0] * b[0] + a[1] * b[1]; }

Place between(const Place& from, const Place& to, const Precise& share) {
  return {from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])};
}

/// The square of the distance of a point from a segment.
Precise squared_distance(const Place& point, const Place& from, const Place& to) {
  const Place edge{to[0] - from[0], to[1] - from[1]};
  const Place way{point[0] - from[0], point[1] - from[1]};
  const Precise length = dot(edge, edge);
  const Precise along = dot(edge, way);
  if (along <= 0) return dot(way, way);
  if (along >= length) {
    const Place rest{point[0] - to[0], point[1] - to[1]};
    return dot(rest, rest);
  }
  const Precise across = edge[0] * way[1] - edge[1] * way[0];
  return across * across / length;
}

/// How far a point is from a polygon with at least one corner; 0 inside.
Precise distance(const Place& point, const Shape& polygon) {
  if (std::find(polygon.begin(), polygon.end(), point) != polygon.end()) return 0;
  bool inside = polygon.size() > 2;
  for (std::size_t i = 0; inside && i < polygon.size(); ++i)
    inside = turn(polygon[i], polygon[(i + 1) % polygon.size()], point) >= 0;
  if (inside) return 0;
  std::optional<Precise> least;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    Precise square = squared_distance(point, polygon[i], polygon[(i + 1) % polygon.size()]);
    if (!least || square < *least) least = std::move(square);
  }
  return sqrt(*least);
}

/// How far a set has moved: the larger of the distances of either's corners from the other.
Precise moved(const Shape& before, const Shape& after) {
  Precise most = 0;
  for (const Place& corner : before) most = std::max(most, distance(corner, after));
  for (const Place& corner : after) most = std::max(most, distance(corner, before));
  return most;
}

/// The part of a polygon where normal . point <= most, give or take rounding.
Shape cut(const Shape& polygon, const Place& normal, const Precise& most) {
  std::vector<Precise> over;
  over.reserve(polygon.size());
  for (const Place& corner : polygon) over.push_back(dot(normal, corner) - most);
  if (std::all_of(over.begin(), over.end(), [](const Precise& value) { return value <= rounding(); })) return polygon;
  Places kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const std::size_t next = (i + 1) % polygon.size();
    if (over[i] <= rounding()) kept.push_back(polygon[i]);
    if ((over[i] <= rounding()) == (over[next] <= rounding())) continue;
    const Precise share = over[i] / (over[i] - over[next]);
    kept.push_back(between(polygon[i], polygon[next], std::clamp(share, Precise(0), Precise(1))));
  }
  return convex_hull(std::move(kept));
}

/// The part of a polygon that pays both seats at least so much, give or take rounding.
Shape paying_at_least(const Shape& polygon, const Place& least) {
  return cut(cut(polygon, {-1, 0}, -least[0]), {0, -1}, -least[1]);
}

/// What two polygons have in common, give or take rounding; the second has at least one corner.
Shape common(Shape polygon, const Shape& other) {
  if (other.size() == 1) return polygon.empty() ? polygon : other;
  for (std::size_t i = 0; i < other.size(); ++i) {
    const Place& from = other[i];
    const Place& to = other[(i + 1) % other.size()];
    const Place outward{to[1] - from[1], from[0] - to[0]};
    polygon = cut(polygon, outward, dot(outward, from));
    if (other.size() == 2)
      polygon = cut(polygon, {to[0] - from[0], to[1] - from[1]}, dot({to[0] - from[0], to[1] - from[1]}, to));
  }
  return polygon;
}

/// The least and the most of the other coordinate where coordinate `axis` of a polygon is `at`.
std::optional<Place> slice(const Shape& polygon, std::size_t axis, const Precise& at) {
  std::optional<Place> range;
  const auto include = [&range](const Precise& value) {
    if (!range) range = {value, value};
    range = {std::min((*range)[0], value), std::max((*range)[1], value)};
  };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Place& from = polygon[i];
    const Place& to = polygon[(i + 1) % polygon.size()];
    if (abs(from[axis] - at) <= rounding()) include(from[1 - axis]);
    if ((from[axis] < at) == (to[axis] < at)) continue;
    const Precise share = (at - from[axis]) / (to[axis] - from[axis]);
    include(from[1 - axis] + share * (to[1 - axis] - from[1 - axis]));
  }
  return range;
}

/// C(a, W, u): `least` is what continuations must pay.
Places continuations(const Place& payoff, const Shape& set, const Place& least) {
  if (payoff[0] >= least[0] - rounding() && payoff[1] >= least[1] - rounding()) return {payoff};
  Places ends;
  for (const std::size_t axis : {0U, 1U}) {
    const auto line = slice(set, axis, least[axis]);
    if (!line || (*line)[1] < least[1 - axis] - rounding()) continue;
    const Precise& high = (*line)[1];
    for (const Precise& end : {std::min(std::max((*line)[0], least[1 - axis]), high), high}) {
      Place point;
      point[axis] = least[axis];
      point[1 - axis] = end;
      ends.push_back(point);
    }
  }
  return ends;
}

}  // namespace

Place lowest(const Polygon<Precise>& polygon) {
  Place least = polygon.front();
  for (const Place& corner : polygon) least = {std::min(least[0], corner[0]), std::min(least[1], corner[1])};
  return least;
}

Polygon<Precise> without_blunt_corners(Polygon<Precise> polygon, const Precise& tolerance) {
  if (polygon.empty()) return polygon;
  const Place least = lowest(polygon);
  const auto pays_the_least_alone = [&](std::size_t i) {
    for (const std::size_t axis : {0U, 1U})
      if (polygon[i][axis] <= least[axis] + rounding() &&
          std::count_if(polygon.begin(), polygon.end(),
                        [&](const Place& corner) { return corner[axis] <= least[axis] + rounding(); }) == 1)
        return true;
    return false;
  };
  const Precise square = tolerance * tolerance;
  for (std::size_t i = 0; i < polygon.size() && polygon.size() > 1;) {
    const Place& before = polygon[(i + polygon.size() - 1) % polygon.size()];
    const Place& after = polygon[(i + 1) % polygon.size()];
    if (squared_distance(polygon[i], before, after) > square || pays_the_least_alone(i)) {
      ++i;
    } else {
      polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(i));
      i = 0;
    }
  }
  return polygon;
}

EquilibriumIteration::EquilibriumIteration(std::vector<RepeatedProfile> profiles, const Point<Precise>& minmax,
                                           const Rational& discount)
    : profiles_(std::move(profiles)),
      threat_(minmax),
      patience_(precise(1 - discount)),
      weight_(precise((1 - discount) / discount)) {
  Places payoffs;
  for (const RepeatedProfile& profile : profiles_) payoffs.push_back(profile.payoff);
  set_ = convex_hull(std::move(payoffs));
}

Place EquilibriumIteration::least_continuation(const RepeatedProfile& profile) const {
  return {threat_[0] + weight_ * (profile.deviation[0] - profile.payoff[0]),
          threat_[1] + weight_ * (profile.deviation[1] - profile.payoff[1])};
}

void EquilibriumIteration::raise_threat() {
  if (set_.empty()) return;
  const Place least = lowest(set_);
  threat_ = {std::max(threat_[0], least[0]), std::max(threat_[1], least[1])};
}

Precise EquilibriumIteration::step() {
  raise_threat();
  Places points;
  // A profile that no continuation supports is not supported by a smaller set and a higher threat either.
  std::erase_if(profiles_, [&](const RepeatedProfile& profile) {
    const Places ends = continuations(profile.payoff, set_, least_continuation(profile));
    for (const Place& end : ends) points.push_back(between(end, profile.payoff, patience_));
    return ends.empty();
  });
  Shape next = convex_hull(std::move(points));
  if (tightened_) next = common(next, set_);  // R of what was cut may reach beyond it
  next = without_blunt_corners(std::move(next), rounding());
  const Precise change = next.empty() ? Precise(0) : moved(set_, next);
  set_ = std::move(next);
  return change <= rounding() ? Precise(0) : change;
}

std::vector<EquilibriumIteration::Supported> EquilibriumIteration::supported() {
  std::vector<Supported> found;
  std::erase_if(profiles_, [&](const RepeatedProfile& profile) {
    Shape left = paying_at_least(set_, least_continuation(profile));
    if (left.empty()) return true;
    found.push_back({profile.payoff, profile.deviation, std::move(left)});
    return false;
  });
  return found;
}

void EquilibriumIteration::tighten_threat(const std::vector<Supported>& profiles) {
  for (const std::size_t axis : {0U, 1U}) {
    std::optional<Precise> least;
    for (const Supported& profile : profiles) {
      const Precise continuation = lowest(profile.continuations)[axis];
      const Precise paid = continuation + patience_ * (profile.payoff[axis] - continuation);
      const Precise bound = std::max(profile.deviation[axis], paid);
      if (!least || bound < *least) least = bound;
    }
    if (least) threat_[axis] = std::max(threat_[axis], *least);
  }
  set_ = paying_at_least(set_, threat_);
}

std::optional<Precise> EquilibriumIteration::most_paid(const Supported& profile, const Place& normal,
                                                       const Precise& own) const {
  Precise low = dot(normal, profile.continuations.front());
  Precise high = low;
  for (const Place& corner : profile.continuations) {
    const Precise value = dot(normal, corner);
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (own < low - rounding()) return std::nullopt;
  return own >= high ? Precise(high + patience_ * (own - high)) : own;
}

std::optional<Precise> EquilibriumIteration::bound(const std::vector<Supported>& profiles, const Place& normal) const {
  std::optional<Precise> most;
  for (const Supported& profile : profiles) {
    const Precise own = dot(normal, profile.payoff);
    if (most && own <= *most) continue;  // it pays no more than that
    const auto paid = most_paid(profile, normal, own);
    if (paid && (!most || *paid > *most)) most = paid;
  }
  return most;
}

bool EquilibriumIteration::pays_more(const std::vector<Supported>& profiles, const Place& normal,
                                     const Precise& limit) const {
  return std::any_of(profiles.begin(), profiles.end(), [&](const Supported& profile) {
    const Precise own = dot(normal, profile.payoff);
    if (own <= limit) return false;
    const auto paid = most_paid(profile, normal, own);
    return paid && *paid > limit;
  });
}

void EquilibriumIteration::shift_edges(const std::vector<Supported>& profiles) {
  std::vector<Place> normals{{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  for (std::size_t i = 0; i < set_.size(); ++i) {
    const Place& from = set_[i];
    const Place& to = set_[(i + 1) % set_.size()];
    normals.push_back({to[1] - from[1], from[0] - to[0]});
    if (set_.size() == 2) normals.push_back({to[0] - from[0], to[1] - from[1]});
  }
  for (const Place& normal : normals) {
    if (set_.empty()) return;
    const auto most = bound(profiles, normal);
    set_ = most ? cut(set_, normal, *most) : Shape{};
  }
}

void EquilibriumIteration::turn_edges(const std::vector<Supported>& profiles) {
  Places through;
  for (const Supported& profile : profiles) {
    through.push_back(profile.payoff);
    for (const Place& w : profile.continuations) through.push_back(between(w, profile.payoff, patience_));
  }
  std::sort(through.begin(), through.end());
  through.erase(std::unique(through.begin(), through.end()), through.end());
  const Shape corners = set_;
  for (std::size_t i = 0; i < corners.size() && corners.size() > 1; ++i)
    for (const std::size_t next : {(i + 1) % corners.size(), (i + corners.size() - 1) % corners.size()})
      turn_edge(profiles, through, corners[i], corners[next]);
}

void EquilibriumIteration::turn_edge(const std::vector<Supported>& profiles, const Places& through, const Place& pivot,
                                     const Place& turned) {
  std::optional<Place> best;
  Precise deepest = 0;
  for (const Place& point : through) {
    Place normal{point[1] - pivot[1], pivot[0] - point[0]};
    const Precise length = dot(normal, normal);
    if (length <= rounding()) continue;
    const Precise depth = dot(normal, {turned[0] - pivot[0], turned[1] - pivot[1]});
    if (depth * depth <= (deepest + rounding()) * length) continue;
    if (depth < 0) normal = {-normal[0], -normal[1]};
    if (pays_more(profiles, normal, dot(normal, pivot) + rounding())) continue;
    deepest = depth * depth / length;
    best = normal;
  }
  if (best) set_ = cut(set_, *best, dot(*best, pivot));
}

void EquilibriumIteration::tighten() {
  tightened_ = true;
  raise_threat();
  tighten_threat(supported());
  const auto profiles = supported();
  shift_edges(profiles);
  turn_edges(profiles);
}

}  // namespace folk
