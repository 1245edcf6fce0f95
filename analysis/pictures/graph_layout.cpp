#include <folk/analysis/pictures/gnuplot_script.h>
#include <folk/analysis/pictures/graph_layout.h>
#include <folk/games/error.h>

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <map>
#include <utility>

namespace folk {
namespace {

constexpr double points_per_inch = 72;

/// The words of a line; one in double quotes may hold blanks and \".
std::vector<std::string> words_of(std::string_view line) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < line.size();) {
    if (line[i] == ' ' || line[i] == '\r') {
      ++i;
      continue;
    }
    std::string word;
    if (line[i] == '"') {
      for (++i; i < line.size() && line[i] != '"'; ++i) {
        if (line[i] == '\\' && i + 1 < line.size() && line[i + 1] == '"') ++i;
        word += line[i];
      }
      ++i;
    } else {
      while (i < line.size() && line[i] != ' ' && line[i] != '\r') word += line[i++];
    }
    words.push_back(std::move(word));
  }
  return words;
}

[[noreturn]] void refuse_plain(std::string_view line) {
  throw EnvironmentError(fmt::format("dot's layout cannot be read: '{}'", excerpt(line)));
}

/// Reads the words of one line one after the other.
class Words {
public:
  explicit Words(std::string_view line)
      : line_(line),
        words_(words_of(line)) {}

  std::size_t left() const { return words_.size() - at_; }

  const std::string& word() {
    if (left() == 0) refuse_plain(line_);
    return words_[at_++];
  }

  double number() {
    const std::string& text = word();
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) refuse_plain(line_);
    return value;
  }

  Spot spot() {
    const double x = points_per_inch * number();
    return {x, points_per_inch * number()};
  }

private:
  std::string_view line_;
  std::vector<std::string> words_;
  std::size_t at_ = 0;
};

/// Where the ray from a place in a direction of length 1 first meets a node, or else `reach` away.
Spot end_of_ray(const Spot& from, const Spot& direction, const PlacedNode& node, double reach) {
  const double a = node.half_width;
  const double b = node.half_height;
  if (a > 0 && b > 0) {
    const Spot p{(from.x - node.centre.x) / a, (from.y - node.centre.y) / b};
    const Spot d{direction.x / a, direction.y / b};
    const double dd = d.x * d.x + d.y * d.y;
    const double pd = p.x * d.x + p.y * d.y;
    const double root = pd * pd - dd * (p.x * p.x + p.y * p.y - 1);
    if (root >= 0)
      if (const double t = (-pd - std::sqrt(root)) / dd; t > reach / 3 && t < 3 * reach) reach = t;
  }
  return {from.x + reach * direction.x, from.y + reach * direction.y};
}

Spot direction_at_end(const std::vector<Spot>& curve) {
  const Spot& last = curve.back();
  for (auto before = curve.rbegin() + 1; before != curve.rend(); ++before) {
    const double length = std::hypot(last.x - before->x, last.y - before->y);
    if (length > 1e-3) return {(last.x - before->x) / length, (last.y - before->y) / length};
  }
  return {1, 0};
}

std::string_view without_blanks(std::string_view text) {
  const auto first = text.find_first_not_of(' ');
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(' ') + 1 - first);
}

}  // namespace

GraphLayout read_plain(std::string_view text, double head) {
  GraphLayout layout;
  std::map<std::string, std::size_t, std::less<>> index;
  const auto node_named = [&](const std::string& name) {
    const auto found = index.find(name);
    if (found == index.end()) refuse_plain(name);
    return found->second;
  };
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    Words words(line);
    if (words.left() == 0) continue;
    const std::string kind = words.word();
    if (kind == "node") {
      PlacedNode node;
      node.name = words.word();
      node.centre = words.spot();
      const Spot size = words.spot();
      node.half_width = size.x / 2;
      node.half_height = size.y / 2;
      index.emplace(node.name, layout.nodes.size());
      layout.nodes.push_back(std::move(node));
    } else if (kind == "edge") {
      PlacedEdge edge;
      edge.from = node_named(words.word());
      edge.to = node_named(words.word());
      const double count = words.number();
      if (count < 4 || std::fmod(count, 3) != 1 || count > static_cast<double>(words.left())) refuse_plain(line);
      for (double i = 0; i < count; ++i) edge.curve.push_back(words.spot());
      edge.tip = end_of_ray(edge.curve.back(), direction_at_end(edge.curve), layout.nodes[edge.to], head);
      if (words.left() > 2) {  // a label and its place come before style and colour
        edge.label = without_blanks(words.word());
        edge.label_at = words.spot();
      }
      layout.edges.push_back(std::move(edge));
    } else if (kind == "stop") {
      return layout;
    } else if (kind != "graph") {
      refuse_plain(line);
    }
  }
  throw EnvironmentError("dot's layout cannot be read: it has no end");
}

std::string with_places(std::string_view dot, const GraphLayout& layout, double label_size) {
  const auto end = dot.rfind('}');
  // Strict: an edge that is named again is the same edge.
  std::string text = fmt::format("strict {}", dot.substr(0, end));
  text += "  outputorder=edgesfirst;\n";
  for (const auto& node : layout.nodes)
    text += fmt::format("  {} [pos=\"{:.2f},{:.2f}\"];\n", node.name, node.centre.x, node.centre.y);
  for (std::size_t i = 0; i < layout.edges.size(); ++i) {
    const auto& edge = layout.edges[i];
    text += fmt::format("  {} -> {} [label=\"\", pos=\"e,{:.2f},{:.2f}", layout.nodes[edge.from].name,
                        layout.nodes[edge.to].name, edge.tip.x, edge.tip.y);
    for (const auto& spot : edge.curve) text += fmt::format(" {:.2f},{:.2f}", spot.x, spot.y);
    text += "\"];\n";
    if (edge.label.empty()) continue;
    text += fmt::format(
        "  l{} [shape=box, style=filled, color=white, fillcolor=white, penwidth=0, fixedsize=true, width={:.3f}, "
        "height={:.3f}, fontsize={}, label=\"{}\", pos=\"{:.2f},{:.2f}\"];\n",
        i, gnuplot::text_width(edge.label, label_size) / points_per_inch, (label_size + 1) / points_per_inch,
        label_size, edge.label, edge.label_at.x, edge.label_at.y);
  }
  return text + "}\n";
}

}  // namespace folk
