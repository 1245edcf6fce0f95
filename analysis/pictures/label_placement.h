#pragma once
// Labels of a laid-out graph put where they can be read: each on its own line, clear of the others.

#include <folk/analysis/pictures/graph_layout.h>

namespace folk {

/// Moves the label of every edge onto the edge itself, to where it lies on the fewest other edges, nodes and labels,
/// near the edge's middle; an edge from a node to itself is turned around the node to where there is room, its label
/// beyond it. `label_size` is that of the letters in points, `head` the length of an arrow's head.
void place_labels(GraphLayout& layout, double label_size, double head);

/// How many edges other than its own the label of an edge lies on; 0 for one without a label.
std::size_t edges_under_label(const GraphLayout& layout, std::size_t edge, double label_size);

}  // namespace folk
