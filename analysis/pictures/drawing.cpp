#include <folk/analysis/pictures/drawing.h>
#include <folk/analysis/pictures/gnuplot_script.h>
#include <folk/games/outcome.h>
#include <folk/games/utf8.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <string_view>
#include <vector>

namespace folk {
namespace {

// Light blue and light orange stay apart for every common colour vision; the letter is always there as well.
constexpr std::string_view fill_cooperate = "#cfe3f7";
constexpr std::string_view fill_defect = "#fcd9b0";
constexpr std::string_view fill_mixed = "#ece8f2";

/// The outcomes (CC, CD, DC, DD) that lead from one state to another.
using Outcomes = std::array<bool, 4>;

/// The size of the names below the moves.
constexpr double name_size = 11;

/// Draws one automaton; `words` come last because they explain only what was drawn.
class Drawing {
public:
  Drawing(const Automaton& automaton, const DrawingOptions& options)
      : automaton_(automaton),
        options_(options) {
    for (std::size_t s = 0; s < automaton.size(); ++s)
      own_matters_ = own_matters_ || (!is_beyond(s) && own_move_matters(automaton.nodes()[s]));
    for (const auto& names : options.state_names)
      for (const auto& name : names) wide_ = wide_ || gnuplot::text_width(name, name_size) > 44;
  }

  std::string text() {
    std::string states;
    for (std::size_t s = 0; s < automaton_.size(); ++s) states += state(s);
    std::string edges;
    for (std::size_t s = 0; s < automaton_.size(); ++s) edges += edges_from(s);
    return fmt::format(
        "digraph \"{0}\" {{\n"
        "  rankdir=LR; bgcolor=white; pad=0.15; nodesep=0.45; ranksep=0.55;\n"
        "  fontname=\"Helvetica\"; fontsize=12; labelloc=b; label=\"\\n{1}\";\n"
        "  node [shape={5}, style=filled, fontname=\"Helvetica\", fontsize=16, width=0.6, penwidth=1.2];\n"
        "  edge [fontname=\"Helvetica\", fontsize=12, arrowsize=0.8];\n"
        "  start [shape=point, width=0.08, label=\"\"];\n"
        "{2}  start -> s{3};\n{4}}}\n",
        dot_text(options_.title), words(), states, automaton_.start(), edges,
        wide_ ? "ellipse, height=0.6, margin=\"0.02,0.02\"" : "circle");
  }

private:
  bool is_beyond(std::size_t s) const { return automaton_.beyond() == s; }

  /// True when both own moves are possible in a state and lead to different ones after the same move of theirs.
  bool own_move_matters(const Automaton::Node& node) const {
    return std::any_of(all_outcomes.begin(), all_outcomes.end(), [&](Outcome outcome) {
      return possible(node.cooperation, outcome, options_.sense) &&
             possible(node.cooperation, outcome.deviated(), options_.sense) &&
             node.next[outcome.index()] != node.next[outcome.deviated().index()];
    });
  }

  /// True when play that leaves state `s` can come back to it.
  bool recurs(std::size_t s) const {
    std::vector<bool> seen(automaton_.size());
    std::vector<std::size_t> open{s};
    while (!open.empty()) {
      const auto& node = automaton_.nodes()[open.back()];
      open.pop_back();
      for (const Outcome outcome : all_outcomes) {
        if (!possible(node.cooperation, outcome, options_.sense)) continue;
        const std::size_t next = node.next[outcome.index()];
        if (next == s) return true;
        if (!seen[next]) open.push_back(next);
        seen[next] = true;
      }
    }
    return false;
  }

  std::string state(std::size_t s) {
    if (is_beyond(s)) return fmt::format("  s{} [label=\"…\", style=solid, shape=plaintext];\n", s);
    const double p = automaton_.nodes()[s].cooperation;
    const bool mixed = p > 0 && p < 1;
    const std::string label = mixed ? fmt::format("P(C)\\n{:.4g}", p) : std::string(p > 0 ? "C" : "D");
    // Past a horizon nothing recurs: dashes would say nothing there.
    const bool once = !automaton_.beyond() && !recurs(s);
    mixes_ = mixes_ || mixed;
    once_ = once_ || once;
    return fmt::format("  s{} [label={}, fillcolor=\"{}\"{}{}];\n", s, with_names(label, s),
                       mixed   ? fill_mixed
                       : p > 0 ? fill_cooperate
                               : fill_defect,
                       mixed ? ", fontsize=12" : "", once ? ", style=\"filled,dashed\"" : "");
  }

  /// A state's label, with the names that its author gave to it below its move.
  std::string with_names(const std::string& label, std::size_t s) const {
    if (s >= options_.state_names.size() || options_.state_names[s].empty()) return fmt::format("\"{}\"", label);
    const auto& names = options_.state_names[s];
    std::string text = label;
    if (const auto at = text.find("\\n"); at != std::string::npos) text.replace(at, 2, "<BR/>");
    constexpr std::size_t most = 3;
    const auto add = [&](const std::string& line) {
      text += fmt::format("<BR/><FONT POINT-SIZE=\"{}\">{}</FONT>", name_size, line);
    };
    for (std::size_t i = 0; i < std::min(most, names.size()); ++i)
      add(gnuplot::xml_text(gnuplot::fitted(names[i], name_size, 120)));
    if (names.size() > most) add(fmt::format("and {} more", names.size() - most));
    return fmt::format("<{}>", text);
  }

  /// "C", "C, D"; with own moves "C/D", "*/C" (either own move), "D/*", "*/*".
  std::string label(const Outcomes& leads, const Outcomes& all) {
    const auto covers = [&](std::size_t a, std::size_t b) { return (leads[a] || !all[a]) && (leads[b] || !all[b]); };
    if (!own_matters_) {
      const bool on_c = leads[0] || leads[2];
      const bool on_d = leads[1] || leads[3];
      return on_c && on_d ? "C, D" : on_c ? "C" : "D";
    }
    if (leads == all && all == Outcomes{true, true, true, true}) return starred("*/*");
    const bool both_own = (all[0] || all[1]) && (all[2] || all[3]);
    if (both_own && covers(0, 2) && !leads[1] && !leads[3]) return starred("*/C");
    if (both_own && covers(1, 3) && !leads[0] && !leads[2]) return starred("*/D");
    std::vector<std::string> parts;
    for (const std::size_t own : {0U, 1U}) {
      const std::string move(1, own == 0 ? 'C' : 'D');
      if (leads[2 * own] && leads[2 * own + 1])
        parts.push_back(starred(move + "/*"));
      else if (leads[2 * own])
        parts.push_back(move + "/C");
      else if (leads[2 * own + 1])
        parts.push_back(move + "/D");
    }
    return fmt::format("{}", fmt::join(parts, ", "));
  }

  std::string starred(std::string text) {
    starred_ = true;
    return text;
  }

  std::string edges_from(std::size_t s) {
    if (is_beyond(s)) return {};
    const auto& node = automaton_.nodes()[s];
    std::map<std::uint32_t, Outcomes> targets;
    Outcomes all{};
    for (const Outcome outcome : all_outcomes) {
      if (!possible(node.cooperation, outcome, options_.sense)) continue;
      targets[node.next[outcome.index()]][outcome.index()] = true;
      all[outcome.index()] = true;
    }
    std::string text;
    for (const auto& [to, leads] : targets)
      text += fmt::format("  s{} -> s{} [label=\" {} \"];\n", s, to, label(leads, all));
    return text;
  }

  std::string words() const {
    std::string text = dot_text(options_.title);
    if (automaton_.beyond()) text += fmt::format(" · first {} rounds", options_.horizon);
    text += own_matters_ ? " · edges: own/their move" : " · edges: their move";
    if (starred_) text += ", * either";
    text += options_.sense == Sense::any_own_moves ? " · any own moves" : " · own moves its own";
    std::vector<std::string> legend;
    if (mixes_) legend.emplace_back("P(C): probability of C");
    if (once_) legend.emplace_back("dashed: visited at most once");
    if (automaton_.beyond()) legend.emplace_back("…: all later rounds");
    if (!legend.empty()) text += fmt::format("\\n{}", fmt::join(legend, " · "));
    return text + "\\n" + dot_text(caption_text(options_.caption));
  }

  const Automaton& automaton_;
  const DrawingOptions& options_;
  bool wide_ = false;  ///< some name has no room in a circle
  bool own_matters_ = false;
  bool mixes_ = false;
  bool once_ = false;
  bool starred_ = false;
};

}  // namespace

std::string dot_text(std::string_view text) {
  std::string line(text);
  std::replace(line.begin(), line.end(), '\n', ' ');
  std::string out;
  for (const char c : visible_text(line)) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out;
}

std::string to_dot(const Automaton& minimised, const DrawingOptions& options) {
  return Drawing(minimised, options).text();
}

}  // namespace folk
