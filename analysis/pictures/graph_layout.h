#pragma once
// Where Graphviz put the parts of a graph: read from its plain format, and handed back to it as the places to draw at.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace folk {

/// A place in points (1/72 inch), to the right and up.
struct Spot {
  double x = 0;
  double y = 0;
};

/// An ellipse.
struct PlacedNode {
  std::string name;
  Spot centre;
  double half_width = 0;
  double half_height = 0;
};

/// An arrow along Bézier curves, and its label.
struct PlacedEdge {
  std::size_t from = 0;  ///< index of a node
  std::size_t to = 0;
  std::vector<Spot> curve;  ///< 3 k + 1 control points; the arrow's head begins at the last one
  Spot tip;                 ///< where the head ends
  std::string label;        ///< without blanks around it; may be empty
  Spot label_at;            ///< its middle
};

struct GraphLayout {
  std::vector<PlacedNode> nodes;
  std::vector<PlacedEdge> edges;
};

/// What `dot -Tplain` prints (documented in the dot guide). Heads are `head` points long where they meet no node.
/// Throws EnvironmentError when it is no such text.
GraphLayout read_plain(std::string_view text, double head);

/// The DOT text that has everything drawn where `layout` says, labels on top of all lines, each on white: for `neato
/// -n2`. `dot` is the text that was laid out, without two edges from one node to another.
std::string with_places(std::string_view dot, const GraphLayout& layout, double label_size);

}  // namespace folk
