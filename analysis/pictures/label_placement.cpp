#include <folk/analysis/pictures/gnuplot_script.h>
#include <folk/analysis/pictures/label_placement.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

namespace folk {
namespace {

/// A rectangle around its middle.
struct Box {
  Spot middle;
  double half_width = 0;
  double half_height = 0;

  bool holds(const Spot& spot) const {
    return std::abs(spot.x - middle.x) < half_width && std::abs(spot.y - middle.y) < half_height;
  }
  bool meets(const Box& other) const {
    return std::abs(other.middle.x - middle.x) < half_width + other.half_width &&
           std::abs(other.middle.y - middle.y) < half_height + other.half_height;
  }
};

/// A curve as many places close to each other, and the box around them.
struct Trace {
  std::vector<Spot> spots;
  Box around;
};

Trace trace_of(const PlacedEdge& edge) {
  Trace trace;
  const auto& c = edge.curve;
  for (std::size_t i = 0; i + 3 < c.size(); i += 3) {
    const double length = std::hypot(c[i + 1].x - c[i].x, c[i + 1].y - c[i].y) +
                          std::hypot(c[i + 2].x - c[i + 1].x, c[i + 2].y - c[i + 1].y) +
                          std::hypot(c[i + 3].x - c[i + 2].x, c[i + 3].y - c[i + 2].y);
    const int steps = std::clamp(static_cast<int>(length / 3), 4, 200);
    for (int k = trace.spots.empty() ? 0 : 1; k <= steps; ++k) {
      const double t = static_cast<double>(k) / steps;
      const double s = 1 - t;
      const auto mixed = [&](double a, double b, double d, double e) {
        return s * s * s * a + 3 * s * s * t * b + 3 * s * t * t * d + t * t * t * e;
      };
      trace.spots.push_back(
          {mixed(c[i].x, c[i + 1].x, c[i + 2].x, c[i + 3].x), mixed(c[i].y, c[i + 1].y, c[i + 2].y, c[i + 3].y)});
    }
  }
  trace.spots.push_back(edge.tip);
  Spot low = trace.spots.front();
  Spot high = low;
  for (const auto& spot : trace.spots) {
    low = {std::min(low.x, spot.x), std::min(low.y, spot.y)};
    high = {std::max(high.x, spot.x), std::max(high.y, spot.y)};
  }
  trace.around = {{(low.x + high.x) / 2, (low.y + high.y) / 2}, (high.x - low.x) / 2 + 0.5, (high.y - low.y) / 2 + 0.5};
  return trace;
}

bool strikes(const Trace& trace, const Box& box) {
  return box.meets(trace.around) &&
         std::any_of(trace.spots.begin(), trace.spots.end(), [&](const Spot& spot) { return box.holds(spot); });
}

/// What a label covers.
Box label_box(const std::string& label, const Spot& middle, double size) {
  return {middle, gnuplot::text_width(label, size) / 2, (size + 1) / 2};
}

/// So many points from a label its own edge alone should be.
constexpr double clearance = 3;

/// Puts the labels down one by one.
class Placement {
public:
  Placement(GraphLayout& layout, double label_size, double head)
      : layout_(layout),
        size_(label_size),
        head_(head) {
    for (const auto& edge : layout.edges) traces_.push_back(trace_of(edge));
    turned_.assign(layout.edges.size(), false);
    for (const auto& node : layout.nodes) nodes_.push_back({node.centre, node.half_width + 1, node.half_height + 1});
  }

  void run() {
    std::vector<std::size_t> order(layout_.edges.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    // Whoever has the least room chooses first; loops, which can turn, last.
    const auto key = [&](std::size_t i) { return std::pair(is_loop(i), traces_[i].spots.size()); };
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
    for (const std::size_t i : order) {
      if (is_loop(i))
        turn(i);
      else if (!layout_.edges[i].label.empty())
        slide(i);
    }
  }

private:
  /// False for a loop of which nobody knows yet where it will be.
  bool placed(std::size_t edge) const { return !is_loop(edge) || turned_[edge]; }

  bool is_loop(std::size_t edge) const { return layout_.edges[edge].from == layout_.edges[edge].to; }

  /// The price of a label there: on other labels, nodes and edges.
  double price_of(const Box& box, std::size_t edge) const {
    double price = 0;
    for (const auto& other : labels_)
      if (box.meets(other)) price += 1000;
    for (const auto& node : nodes_)
      if (box.meets(node)) price += 500;
    for (std::size_t i = 0; i < traces_.size(); ++i)
      if (i != edge && placed(i) && strikes(traces_[i], grown(box, clearance))) price += 100;
    return price;
  }

  void slide(std::size_t i) {
    auto& edge = layout_.edges[i];
    const auto& spots = traces_[i].spots;
    double best = std::numeric_limits<double>::infinity();
    constexpr int candidates = 40;
    for (int k = 0; k <= candidates; ++k) {
      const double share = 0.1 + 0.8 * k / candidates;
      const Spot middle = spots[static_cast<std::size_t>(share * static_cast<double>(spots.size() - 1))];
      const Box box = label_box(edge.label, middle, size_);
      // A label must not hide the arrow's head, nor where the edge begins.
      const bool hides_end =
          grown(box, 3).holds(spots.back()) || grown(box, 1).holds(edge.curve.back()) || box.holds(spots.front());
      const double price = price_of(box, i) + (hides_end ? 300 : 0) + 40 * std::abs(share - 0.5);
      if (price >= best) continue;
      best = price;
      edge.label_at = middle;
    }
    labels_.push_back(label_box(edge.label, edge.label_at, size_));
  }

  static Box grown(Box box, double by) { return {box.middle, box.half_width + by, box.half_height + by}; }

  /// A loop in a direction from its node, its label beyond it.
  PlacedEdge turned_to(const PlacedEdge& edge, double angle) const {
    constexpr double spread = 0.42;  // radians to each side
    constexpr double reach = 38;
    const PlacedNode& node = layout_.nodes[edge.to];
    const auto on_node = [&](double a, double further) {
      return Spot{node.centre.x + (node.half_width + further) * std::cos(a),
                  node.centre.y + (node.half_height + further) * std::sin(a)};
    };
    PlacedEdge loop = edge;
    loop.tip = on_node(angle - spread, 0);
    const Spot from = on_node(angle + spread, 0);
    const Spot out = on_node(angle + spread, reach);
    const Spot back = on_node(angle - spread, reach);
    const double length = std::hypot(back.x - loop.tip.x, back.y - loop.tip.y);
    loop.curve = {
        from,
        out,
        back,
        {loop.tip.x + head_ * (back.x - loop.tip.x) / length, loop.tip.y + head_ * (back.y - loop.tip.y) / length}};
    if (loop.label.empty()) return loop;
    const Box box = label_box(loop.label, {}, size_);
    const double beyond =
        0.72 * reach + std::abs(std::cos(angle)) * box.half_width + std::abs(std::sin(angle)) * box.half_height;
    loop.label_at = on_node(angle, beyond);
    return loop;
  }

  void turn(std::size_t i) {
    constexpr double up = std::numbers::pi / 2;
    // Where equally much is in the way the first is taken.
    constexpr std::array<double, 12> turns{0, 2, -0.5, 0.5, 1.5, -1.5, -1, 1, -0.25, 0.25, 1.75, -1.75};
    double best = std::numeric_limits<double>::infinity();
    PlacedEdge chosen;
    for (std::size_t k = 0; k < turns.size(); ++k) {
      const PlacedEdge loop = turned_to(layout_.edges[i], up + turns[k] * up);
      const Box box = label_box(loop.label, loop.label_at, size_);
      const Trace trace = trace_of(loop);
      double price = 3 * static_cast<double>(k) + crossings(i, trace);
      if (!loop.label.empty()) price += price_of(box, i);
      if (price >= best) continue;
      best = price;
      chosen = loop;
    }
    layout_.edges[i] = chosen;
    traces_[i] = trace_of(chosen);
    turned_[i] = true;
    if (!chosen.label.empty()) labels_.push_back(label_box(chosen.label, chosen.label_at, size_));
  }

  /// The price of a loop along this trace.
  double crossings(std::size_t edge, const Trace& trace) const {
    constexpr double near = 4;
    const Box zone = grown(trace.around, near);
    double price = 0;
    for (std::size_t i = 0; i < traces_.size(); ++i)
      if (i != edge && placed(i) && strikes(traces_[i], zone)) price += 60;
    for (const auto& label : labels_)
      if (zone.meets(label)) price += 300;
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      if (i != layout_.edges[edge].to && zone.meets(nodes_[i])) price += 300;
    return price;
  }

  GraphLayout& layout_;
  double size_;
  double head_;
  std::vector<Trace> traces_;
  std::vector<Box> nodes_;
  std::vector<Box> labels_;
  std::vector<bool> turned_;
};

}  // namespace

void place_labels(GraphLayout& layout, double label_size, double head) { Placement(layout, label_size, head).run(); }

std::size_t edges_under_label(const GraphLayout& layout, std::size_t edge, double label_size) {
  const auto& chosen = layout.edges[edge];
  if (chosen.label.empty()) return 0;
  const Box box = label_box(chosen.label, chosen.label_at, label_size);
  std::size_t count = 0;
  for (std::size_t i = 0; i < layout.edges.size(); ++i)
    if (i != edge && strikes(trace_of(layout.edges[i]), box)) ++count;
  return count;
}

}  // namespace folk
