#pragma once
// The pictures of a tournament that people expect: a heat map of a matrix, a box plot of mean scores; drawn by gnuplot.

#include <folk/analysis/pictures/caption.h>
#include <folk/analysis/pictures/render.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace folk {

/// A cell of a matrix over ordered pairs of strategies. A value that is not finite means "not played".
using PairValue = std::function<double(std::size_t row, std::size_t column)>;

/// More strategies than this make no readable picture.
inline constexpr std::size_t most_plotted = 300;

/// Numbers are written into the cells of a heat map of at most this many strategies.
inline constexpr std::size_t most_numbered = 24;

/// What each strategy (row) got against each other (column), as colours.
struct HeatMap {
  std::vector<std::string> names;  ///< in rank order, the first at the top and at the left
  PairValue value;                 ///< cells that are not finite stay grey
  std::string title;
  std::string unit;                            ///< what a colour means: "points a round"
  std::optional<std::array<double, 2>> range;  ///< lowest and highest colour; by default those of the values
  Caption caption{};
};

/// How one strategy's mean scores spread over its opponents, for every strategy.
struct BoxPlot {
  std::vector<std::string> names;  ///< in rank order, the first at the top
  PairValue value;                 ///< mean score a round of the row; values that are not finite are left out
  std::string title;
  std::string unit;  ///< the axis: "mean score a round"
  Caption caption{};
};

/// The whole gnuplot script, data included, that draws into `output` (any path; nothing in a name or a path is
/// executed). A value beyond a map's range has the colour of its end. Throws UsageError on no names, more than
/// most_plotted, and a range that is not two finite numbers of which the second is the greater.
std::string heat_map_script(const HeatMap& map, PictureFormat format);
std::string box_plot_script(const BoxPlot& plot, PictureFormat format);

/// Throws what draw would throw before it draws, so that it shows before a long tournament and not after: UsageError on
/// more than most_plotted strategies, RendererMissing without gnuplot.
void require_plotter(std::size_t strategies);

/// Draws to a file whose extension is .svg, .png or .pdf; a failure leaves no half picture.
/// Throws UsageError as above and on another extension, RendererMissing without gnuplot, EnvironmentError when it fails
/// or the file cannot be written.
void draw(const HeatMap& map, const std::filesystem::path& path);
void draw(const BoxPlot& plot, const std::filesystem::path& path);

}  // namespace folk
