#pragma once
// Who takes over whom, with which probability, as a graph in the DOT language of Graphviz.

#include <folk/analysis/evolution/fixation.h>
#include <folk/analysis/pictures/caption.h>

#include <string>
#include <vector>

namespace folk {

/// More strategies than this make no readable graph.
inline constexpr std::size_t most_drawn_fixations = 12;

/// The DOT text of `fixation` among strategies of these names; `title` comes first in the words below it, the caption
/// last.
///
/// As in the graph of invasions an arrow leads from the mutant to the resident that it takes over. It is drawn where
/// selection favours that, with N times the probability beside it, thicker where that is more; dashed with two heads
/// where both are neutral. A box holds its share of the time under rare mutations where `distribution` is not empty,
/// and is the darker the larger it is. Throws UsageError on more than most_drawn_fixations.
std::string to_dot(const FixationProbabilities& fixation, const std::vector<double>& distribution,
                   const std::vector<std::string>& names, const std::string& title, const Caption& caption = {});

}  // namespace folk
