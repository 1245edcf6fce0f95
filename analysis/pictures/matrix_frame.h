#pragma once
// What all pictures of a matrix over pairs of strategies share: cells, names at the left and the top, what they are.

#include <folk/analysis/pictures/gnuplot_script.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace folk::gnuplot {

/// Cells have white lines between them in a matrix of at most this many strategies.
inline constexpr std::size_t most_lined = 60;

/// The side of a cell in pixels, where a row has one for each of so many strategies.
double cell_size(std::size_t strategies);

/// The frame of the matrix, as wide and as high as its names need; what stands beside and below it is to be added to
/// width and height.
Layout matrix_layout(const std::vector<std::string>& names);

/// Axes on which the cell of row i and column j has its middle at x = j, y = i and a side of 1. `rows` and `columns`
/// say what they are.
std::string matrix_axes(const Layout& layout, const std::vector<std::string>& names, std::string_view rows,
                        std::string_view columns);

}  // namespace folk::gnuplot
