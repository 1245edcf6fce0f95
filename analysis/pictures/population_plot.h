#pragma once
// Populations over the generations: lines, a stack, and how much is cooperated; drawn by gnuplot.

#include <folk/analysis/evolution/population_history.h>
#include <folk/analysis/pictures/caption.h>
#include <folk/analysis/pictures/render.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace folk {

/// More strategies than this are drawn as "others".
inline constexpr std::size_t most_coloured = 10;

/// A population's way.
struct PopulationPlot {
  std::vector<std::string> names;            ///< of the strategies, in roster order
  std::vector<std::size_t> ranking;          ///< strategies, best first: the order of the legend
  std::vector<PopulationHistory::Row> rows;  ///< generations in order
  std::string title;
  bool shares = false;  ///< shares that add up to 1, not individuals
  Caption caption{};
};

/// Numbers as lines on a logarithmic axis; the generations too where there are many. The most_coloured that were most
/// on average have a colour and a name, the others are grey. Throws UsageError without rows or names.
std::string population_lines_script(const PopulationPlot& plot, PictureFormat format);

/// The same strategies as areas upon each other.
std::string population_stack_script(const PopulationPlot& plot, PictureFormat format);

/// The share of C in all moves, a point a generation.
struct CooperationPlot {
  std::vector<std::pair<std::uint64_t, double>> shares;  ///< generation, 0 to 1
  std::string title;
  Caption caption{};
};

std::string cooperation_script(const CooperationPlot& plot, PictureFormat format);

/// Draw to a file that ends in .svg, .png or .pdf, as gnuplot::draw_script does and throws.
void draw_lines(const PopulationPlot& plot, const std::filesystem::path& path);
void draw_stack(const PopulationPlot& plot, const std::filesystem::path& path);
void draw(const CooperationPlot& plot, const std::filesystem::path& path);

}  // namespace folk
