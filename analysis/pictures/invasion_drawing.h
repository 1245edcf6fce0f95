#pragma once
// Who can invade whom, as a graph for people, in the DOT language of Graphviz.

#include <folk/analysis/evolution/invasion.h>
#include <folk/analysis/pictures/caption.h>

#include <string>
#include <string_view>
#include <vector>

namespace folk {

/// More strategies than this make no readable graph.
inline constexpr std::size_t most_drawn_invasions = 40;

/// The fill of a strategy's box: green, blue, white, grey.
std::string_view stability_colour(Stability stability);

/// The DOT text of `invasions` among strategies of these names; `title` comes first in the words below it, the caption
/// last.
///
/// An arrow leads from the mutant to the resident that it invades: solid where it does strictly, dashed where weakly,
/// dotted where that is undecided; two heads where both invade each other alike. Its colour only tells it from the
/// arrows of other mutants; none is one of a fill. A box is green with a double line where it is evolutionarily stable,
/// blue neutrally stable, white invaded, grey undecided. So that few arrows say it all, strategies that stand alike to
/// all others and to each other share a box, and a frame holds those of whom each can invade each other weakly, instead
/// of their arrows; an arrow from or to the frame is one from or to each in it.
/// Throws UsageError on more than most_drawn_invasions.
std::string to_dot(const Invasions& invasions, const std::vector<std::string>& names, const std::string& title,
                   const Caption& caption = {});

}  // namespace folk
