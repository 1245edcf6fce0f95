#pragma once
// An automaton as a picture for people, in the DOT language of Graphviz.

#include <folk/analysis/pictures/caption.h>
#include <folk/strategies/automaton.h>

#include <string>
#include <string_view>
#include <vector>

namespace folk {

struct DrawingOptions {
  std::string title;                       ///< name of the strategy
  Sense sense = Sense::own_moves_its_own;  ///< the sense in which the automaton was minimised
  unsigned horizon = 0;                    ///< rounds that were unrolled, for the caption; 0: none
  std::vector<std::vector<std::string>>
      state_names{};  ///< of each state what its author calls it (names_behind), or none
  Caption caption{};
};

/// The DOT text of a minimised automaton.
///
/// A circle is a state and holds its move, or P(C) where it mixes, and below it the names that its author gave to what
/// it stands for; with long names ellipses are drawn. An arrow without origin marks the start. Edges are labelled with
/// the opponent's move, or with "own/their" moves throughout when some state's successor depends on its own move;
/// parallel edges are one. A dashed circle is visited at most once (an opening, or a step on the way to a state that is
/// never left). The state beyond a horizon is drawn as "…". Below stand the sense of the drawing, and the caption.
std::string to_dot(const Automaton& minimised, const DrawingOptions& options);

/// Any text inside the double quotes of the DOT language, on one line, as visible_text shows it.
std::string dot_text(std::string_view text);

}  // namespace folk
