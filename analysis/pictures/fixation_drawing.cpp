#include <folk/analysis/pictures/drawing.h>
#include <folk/analysis/pictures/fixation_drawing.h>
#include <folk/games/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace folk {
namespace {

constexpr double neutral_within = 1e-9;

/// White to a light blue on which black is read well.
std::string box_fill(double share) {
  const auto channel = [&](double at_one) { return static_cast<int>(std::lround(255 + share * (at_one - 255))); };
  return fmt::format("#{:02x}{:02x}{:02x}", channel(0x6b), channel(0xae), channel(0xd6));
}

}  // namespace

std::string to_dot(const FixationProbabilities& fixation, const std::vector<double>& distribution,
                   const std::vector<std::string>& names, const std::string& title, const Caption& caption) {
  const std::size_t n = fixation.strategies;
  if (n > most_drawn_fixations)
    throw UsageError(fmt::format("{} strategies are too many for a graph of fixation probabilities: at most {}", n,
                                 most_drawn_fixations));
  constexpr std::string_view face = "fontname=\"Helvetica\"";
  std::string text = fmt::format(
      "digraph fixation {{\n"
      "  bgcolor=white; pad=0.2; nodesep=0.5; ranksep=0.9;\n"
      "  {0}; fontsize=12; labelloc=b; label=\"\\n{1}\\narrow: from the mutant to the resident that it takes over, "
      "where selection favours it,\\nwith N times the probability for a single one; dashed: neutral{2}\n{3}\";\n"
      "  node [shape=box, style=\"rounded,filled\", {0}, fontsize=14, penwidth=1.2];\n"
      "  edge [arrowsize=0.7, {0}, fontsize=11];\n",
      face, dot_text(title), distribution.empty() ? "" : "\\nshare: of the time, when mutations are rare",
      dot_text(caption_text(caption)));
  for (std::size_t i = 0; i < n; ++i) {
    const std::string share = distribution.empty() ? "" : fmt::format("\\n{:.1f} %", 100 * distribution[i]);
    text += fmt::format("  s{} [label=\"{}{}\", fillcolor=\"{}\"];\n", i, dot_text(names[i]), share,
                        distribution.empty() ? "#ffffff" : box_fill(distribution[i]));
  }
  for (std::size_t mutant = 0; mutant < n; ++mutant)
    for (std::size_t resident = 0; resident < n; ++resident) {
      if (mutant == resident) continue;
      const double ratio = fixation.ratio(mutant, resident);
      const double back = fixation.ratio(resident, mutant);
      if (std::abs(ratio - 1) <= neutral_within) {
        const bool both = std::abs(back - 1) <= neutral_within;
        if (both && mutant > resident) continue;
        text += fmt::format("  s{} -> s{} [style=dashed{}];\n", mutant, resident, both ? ", dir=both" : "");
      } else if (ratio > 1) {
        text += fmt::format("  s{} -> s{} [label=\" {:.3g}\", penwidth={:.2f}];\n", mutant, resident, ratio,
                            std::clamp(1 + std::log10(ratio), 1.0, 4.0));
      }
    }
  return text + "}\n";
}

}  // namespace folk
