#include <folk/analysis/pictures/drawing.h>
#include <folk/analysis/pictures/invasion_drawing.h>
#include <folk/games/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <utility>

namespace folk {
namespace {

constexpr std::string_view font = "fontname=\"Helvetica\"";

/// Dark colours that stay apart for every common colour vision (after Okabe & Ito 2008): one line is followed among
/// many by its colour. Greens and blues are left out, which say how stable a box is.
constexpr std::array<std::string_view, 6> inks{"#000000", "#b35900", "#a3437d", "#7a6a00", "#7d7d7d", "#8c2d04"};

/// Of boxes and the frame, so that no border can be taken for a meaning.
constexpr std::string_view border = "#444444";

std::string_view line(Invasion invasion) {
  switch (invasion) {
    case Invasion::strictly: return "solid";
    case Invasion::weakly: return "dashed";
    default: return "dotted";
  }
}

/// Strategies in one box.
using Members = std::vector<std::size_t>;

class InvasionDrawing {
public:
  InvasionDrawing(const Invasions& invasions, const std::vector<std::string>& names)
      : invasions_(invasions),
        names_(names) {
    gather_boxes();
    find_frame();
  }

  std::string text(const std::string& title, const Caption& caption) const {
    std::string body;
    std::string inside;
    for (std::size_t b = 0; b < boxes_.size(); ++b) (framed_[b] ? inside : body) += box(b);
    if (!inside.empty())
      body = fmt::format(
                 "  subgraph cluster_neutral {{\n    label=\"\"; style=\"rounded,dashed\"; color=\"{}\"; margin=14;\n"
                 "{}  }}\n",
                 border, inside) +
             body;
    return fmt::format(
        "digraph invasions {{\n"
        "  compound=true; bgcolor=white; pad=0.2; nodesep=0.35; ranksep=0.8;\n"
        "  {0}; fontsize=12; labelloc=b; label=\"\\n{1}\\n{2}\\n{3}\";\n"
        "  node [shape=box, style=\"rounded,filled\", {0}, fontsize=14, penwidth=1.2, color=\"{4}\"];\n"
        "  edge [arrowsize=0.7, penwidth=1.1];\n{5}{6}}}\n",
        font, dot_text(title), legend(!inside.empty()), dot_text(caption_text(caption)), border, body, arrows());
  }

private:
  static std::string_view ink(std::size_t box) { return inks[box % inks.size()]; }

  Invasion between(std::size_t mutant_box, std::size_t resident_box) const {
    return invasions_.invasion(boxes_[mutant_box].front(), boxes_[resident_box].front());
  }

  /// True when exchanging the two changes nothing.
  bool alike(std::size_t a, std::size_t b) const {
    if (invasions_.invasion(a, b) != invasions_.invasion(b, a) || invasions_.invasion(a, b) != Invasion::weakly)
      return false;
    for (std::size_t k = 0; k < invasions_.size(); ++k)
      if (k != a && k != b &&
          (invasions_.invasion(a, k) != invasions_.invasion(b, k) ||
           invasions_.invasion(k, a) != invasions_.invasion(k, b)))
        return false;
    return true;
  }

  void gather_boxes() {
    for (std::size_t i = 0; i < invasions_.size(); ++i) {
      const auto home =
          std::find_if(boxes_.begin(), boxes_.end(), [&](const Members& box) { return alike(box.front(), i); });
      if (home == boxes_.end())
        boxes_.push_back({i});
      else
        home->push_back(i);
    }
  }

  bool neutral(std::size_t a, std::size_t b) const {
    return between(a, b) == Invasion::weakly && between(b, a) == Invasion::weakly;
  }

  /// The largest set of boxes found by adding whoever is neutral to all so far; fewer than three need no frame.
  void find_frame() {
    framed_.assign(boxes_.size(), false);
    Members best;
    for (std::size_t first = 0; first < boxes_.size(); ++first) {
      Members set{first};
      for (std::size_t b = 0; b < boxes_.size(); ++b)
        if (b != first && std::all_of(set.begin(), set.end(), [&](std::size_t a) { return neutral(a, b); }))
          set.push_back(b);
      if (set.size() > best.size()) best = std::move(set);
    }
    if (best.size() < 3) return;
    frame_ = std::move(best);
    for (const std::size_t b : frame_) framed_[b] = true;
  }

  std::string box(std::size_t b) const {
    std::string label;
    for (const std::size_t i : boxes_[b]) label += (label.empty() ? "" : "\\n") + dot_text(names_[i]);
    const Stability stability = invasions_.stability(boxes_[b].front());
    return fmt::format("  {}b{} [label=\"{}\", fillcolor=\"{}\"{}];\n", framed_[b] ? "  " : "", b, label,
                       stability_colour(stability),
                       stability == Stability::evolutionarily_stable ? ", peripheries=2" : "");
  }

  /// What all in the frame do to a box, or (`to_frame`) it to all of them; resists where they differ.
  Invasion of_frame(std::size_t b, bool to_frame) const {
    if (frame_.empty()) return Invasion::resists;
    const auto how = [&](std::size_t a) { return to_frame ? between(b, a) : between(a, b); };
    const bool same =
        std::all_of(frame_.begin(), frame_.end(), [&](std::size_t a) { return how(a) == how(frame_[0]); });
    return same ? how(frame_[0]) : Invasion::resists;
  }

  static std::string arrow(std::size_t from, std::size_t to, Invasion how, std::string_view more = "") {
    return fmt::format("  b{} -> b{} [style={}, color=\"{}\"{}];\n", from, to, line(how), ink(from), more);
  }

  std::string arrows() const {
    std::string text;
    for (std::size_t b = 0; b < boxes_.size(); ++b) {
      if (framed_[b]) continue;
      if (const Invasion how = of_frame(b, false); how != Invasion::resists)
        text += arrow(frame_[frame_.size() / 2], b, how, ", ltail=cluster_neutral, penwidth=2");
      if (const Invasion how = of_frame(b, true); how != Invasion::resists)
        text += arrow(b, frame_[frame_.size() / 2], how, ", lhead=cluster_neutral, penwidth=2");
    }
    for (std::size_t a = 0; a < boxes_.size(); ++a)
      for (std::size_t b = 0; b < boxes_.size(); ++b)
        if (drawn(a, b)) text += arrow(a, b, between(a, b), both_ways(a, b) ? ", dir=both" : "");
    return text;
  }

  bool both_ways(std::size_t a, std::size_t b) const { return between(a, b) == between(b, a) && drawn_one_way(b, a); }

  /// True when the arrow from a to b is drawn by itself; of two alike only the first.
  bool drawn(std::size_t a, std::size_t b) const { return drawn_one_way(a, b) && !(a > b && both_ways(a, b)); }

  bool drawn_one_way(std::size_t a, std::size_t b) const {
    if (a == b || between(a, b) == Invasion::resists || (framed_[a] && framed_[b])) return false;
    if (framed_[a]) return of_frame(b, false) == Invasion::resists;
    if (framed_[b]) return of_frame(a, true) == Invasion::resists;
    return true;
  }

  /// What the lines and the boxes mean that were drawn.
  std::string legend(bool with_frame) const {
    std::string text = "arrow: from the mutant to the resident that it invades; solid strictly, dashed weakly";
    for (std::size_t i = 0; i < invasions_.size(); ++i)
      if (!invasions_.mutants(i, Invasion::undecided).empty()) {
        text += ", dotted undecided";
        break;
      }
    text += ", two heads each the other\\nits colour only tells it from the arrows of others";
    text += "\\ngreen, double line: evolutionarily stable; blue: neutrally stable; white: invaded";
    for (std::size_t i = 0; i < invasions_.size(); ++i)
      if (invasions_.stability(i) == Stability::undecided) {
        text += "; grey: undecided";
        break;
      }
    return text + (with_frame ? "\\nin the frame each invades each weakly; a thick arrow is for all of them" : "");
  }

  const Invasions& invasions_;
  const std::vector<std::string>& names_;
  std::vector<Members> boxes_;
  Members frame_;             // boxes
  std::vector<bool> framed_;  // by box
};

}  // namespace

std::string_view stability_colour(Stability stability) {
  switch (stability) {
    case Stability::evolutionarily_stable: return "#a8d8a8";
    case Stability::neutrally_stable: return "#cfe3f7";
    case Stability::invaded: return "#ffffff";
    case Stability::undecided: break;
  }
  return "#d0d0d0";
}

std::string to_dot(const Invasions& invasions, const std::vector<std::string>& names, const std::string& title,
                   const Caption& caption) {
  if (invasions.size() > most_drawn_invasions)
    throw UsageError(fmt::format("{} strategies are too many for a graph of invasions: at most {}", invasions.size(),
                                 most_drawn_invasions));
  return InvasionDrawing(invasions, names).text(title, caption);
}

}  // namespace folk
