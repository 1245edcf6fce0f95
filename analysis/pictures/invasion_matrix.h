#pragma once
// Who can invade whom, as a matrix for people, drawn by gnuplot: readable where a graph would be a tangle.

#include <folk/analysis/evolution/invasion.h>
#include <folk/analysis/pictures/caption.h>
#include <folk/analysis/pictures/render.h>

#include <cstddef>
#include <string>
#include <vector>

namespace folk {

/// The order of the matrix: the stable first (evolutionarily, neutrally, undecided, invaded), among those alike in this
/// whom fewer invade strictly, then who invades more strictly, then the roster's order.
std::vector<std::size_t> invasion_order(const Invasions& invasions);

/// The whole gnuplot script of the matrix: the colour of a cell says whether the mutant (row) invades the resident
/// (column), a strip below how stable each resident is. Throws UsageError on names of another number, no names, and
/// more than most_plotted (plots.h).
std::string invasion_matrix_script(const Invasions& invasions, const std::vector<std::string>& names,
                                   const std::string& title, const Caption& caption, PictureFormat format);

}  // namespace folk
