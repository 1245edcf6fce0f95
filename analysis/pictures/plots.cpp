#include <folk/analysis/pictures/box_summary.h>
#include <folk/analysis/pictures/gnuplot_script.h>
#include <folk/analysis/pictures/matrix_frame.h>
#include <folk/analysis/pictures/plots.h>
#include <folk/games/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>

namespace folk {
namespace {

namespace fs = std::filesystem;
using namespace gnuplot;

void check(std::size_t strategies) {
  if (strategies == 0) throw UsageError("a picture needs at least one strategy");
  if (strategies > most_plotted)
    throw UsageError(
        fmt::format("{} strategies are too many for a picture: at most {}; choose fewer or use the CSV files",
                    strategies, most_plotted));
}

// ---- Heat map ------------------------------------------------------------------------------------------------------

/// Viridis (van der Walt & Smith 2015) at equal steps: perceptually uniform, safe for the colour-blind, fine in grey.
constexpr std::array<std::uint32_t, 9> viridis{0x440154, 0x472d7b, 0x3b528b, 0x2c728e, 0x21918c,
                                               0x28ae80, 0x5ec962, 0xaddc30, 0xfde725};

std::string palette() {
  std::string text = "set palette defined (";
  for (std::size_t i = 0; i < viridis.size(); ++i)
    text += fmt::format("{}{} '#{:06x}'", i == 0 ? "" : ", ", i, viridis[i]);
  return text + ")\n";
}

/// White on the dark part of the palette, black where its luminance gives black the greater contrast.
std::uint32_t ink(double value, const std::array<double, 2>& range) {
  return (value - range[0]) / (range[1] - range[0]) < 0.45 ? 0xffffff : 0x000000;
}

bool any_played(const HeatMap& map) {
  for (std::size_t i = 0; i < map.names.size(); ++i)
    for (std::size_t j = 0; j < map.names.size(); ++j)
      if (std::isfinite(map.value(i, j))) return true;
  return false;
}

std::array<double, 2> colour_range(const HeatMap& map) {
  std::array<double, 2> range{INFINITY, -INFINITY};
  if (map.range) {
    range = *map.range;
    if (!std::isfinite(range[0]) || !std::isfinite(range[1]) || range[0] >= range[1])
      throw UsageError("a heat map's range is not two finite numbers, the second the greater");
    return range;
  }
  for (std::size_t i = 0; i < map.names.size(); ++i)
    for (std::size_t j = 0; j < map.names.size(); ++j)
      if (const double value = map.value(i, j); std::isfinite(value))
        range = {std::min(range[0], value), std::max(range[1], value)};
  if (range[0] > range[1]) return {0, 1};
  if (range[0] == range[1]) return {range[0] - 0.5, range[1] + 0.5};
  return range;
}

/// Below a map of which a value lies beyond the range.
constexpr std::string_view beyond_note = "beyond the scale: the colour of its end";

/// True when some value lies beyond the range by more than rounding.
bool exceeds(const HeatMap& map, const std::array<double, 2>& range) {
  const double room = 1e-9 * (range[1] - range[0]);
  for (std::size_t i = 0; i < map.names.size(); ++i)
    for (std::size_t j = 0; j < map.names.size(); ++j)
      if (const double value = map.value(i, j);
          std::isfinite(value) && (value < range[0] - room || value > range[1] + room))
        return true;
  return false;
}

/// How all numbers of a heat map are written, so that they fit their cells.
std::string number_format(const HeatMap& map) {
  double largest = 0;
  bool whole = true;
  for (std::size_t i = 0; i < map.names.size(); ++i)
    for (std::size_t j = 0; j < map.names.size(); ++j)
      if (const double value = map.value(i, j); std::isfinite(value)) {
        largest = std::max(largest, std::abs(value));
        whole = whole && value == std::floor(value);
      }
  if (largest >= 99999.5) return "{:.1e}";
  if (whole || largest >= 999.5) return "{:.0f}";
  return largest >= 99.5 ? "{:.1f}" : "{:.2f}";
}

Layout heat_map_layout(const HeatMap& map) {
  Layout layout = matrix_layout(map.names);
  layout.width = layout.right + 110;
  if (exceeds(map, colour_range(map))) {
    layout.width = std::max(layout.width, 14 + text_width(beyond_note, note_font) + 14);
    layout.height += 12;
  }
  return with_words(layout, map.title, map.caption);
}

/// A line a row of the matrix; "?" where nothing was played.
std::string matrix_data(const HeatMap& map) {
  std::string text = "$MATRIX << END_OF_MATRIX\n";
  for (std::size_t i = 0; i < map.names.size(); ++i)
    for (std::size_t j = 0; j < map.names.size(); ++j) {
      const double value = map.value(i, j);
      text += std::isfinite(value) ? fmt::format("{}", value) : "?";
      text += j + 1 < map.names.size() ? " " : "\n";
    }
  return text + "END_OF_MATRIX\n";
}

/// "column row value ink number" a line, for the cells that were played.
std::string cell_data(const HeatMap& map, const std::array<double, 2>& range) {
  const std::string format = number_format(map);
  std::string text = "$CELLS << END_OF_CELLS\n";
  for (std::size_t i = 0; i < map.names.size(); ++i)
    for (std::size_t j = 0; j < map.names.size(); ++j)
      if (const double value = map.value(i, j); std::isfinite(value))
        // Minus zero would be written -0.
        text += fmt::format("{} {} {} {} {}\n", j, i, value, ink(value, range),
                            fmt::format(fmt::runtime(format), value == 0 ? 0.0 : value));
  return text + "END_OF_CELLS\n";
}

std::string heat_map_axes(const HeatMap& map, const Layout& layout, const std::array<double, 2>& range) {
  const std::string note = fmt::format("font ',{}' textcolor rgb '#444444'\n", note_font);
  std::string text = palette() + matrix_axes(layout, map.names, "strategy", "against");
  text += fmt::format("set cbrange [{}:{}]\n", range[0], range[1]);
  text += "set object rectangle from graph 0,0 to graph 1,1 behind fillcolor rgb '#e4e4e4' fillstyle solid noborder\n";
  text +=
      fmt::format("set colorbox user origin {},{} size {},{}\n", layout.x(layout.right + 16), layout.y(layout.bottom),
                  layout.x(14), fmt::format("screen {:.6f}", (layout.bottom - layout.top) / layout.height));
  text += fmt::format("set cbtics format '%g' scale 0.3 font ',{}' textcolor rgb 'black'\nset cblabel {} font ',12'\n",
                      note_font, text_literal(map.unit));
  if (exceeds(map, range))
    text += fmt::format("set label {} at {},{} left {}", text_literal(beyond_note), layout.x(14),
                        layout.y(layout.bottom + 18), note);
  return text;
}

/// A plot command that draws nothing, for data without a single point, which gnuplot refuses.
constexpr std::string_view nothing = "plot -9 notitle\n";

std::string heat_map_cells(const HeatMap& map, const std::array<double, 2>& range, PictureFormat format) {
  if (!any_played(map)) return std::string(nothing);
  const std::size_t n = map.names.size();
  if (n > most_lined) {
    // One image; in SVG squares, because browsers blur an enlarged image.
    const std::string_view style = format == PictureFormat::svg ? "image pixels" : "image";
    return matrix_data(map) + fmt::format("set datafile missing '?'\nplot $MATRIX matrix using 1:2:3 with {}\n", style);
  }
  std::string text = cell_data(map, range);
  text +=
      "plot $CELLS using 1:2:($1-0.5):($1+0.5):($2-0.5):($2+0.5):3 with boxxyerror lc palette lw 0.5 "
      "fillstyle solid 1 border rgb 'white'";
  if (n <= most_numbered)
    text +=
        fmt::format(", \\\n     $CELLS using 1:2:5:4 with labels font ',{}' textcolor rgb variable", n <= 8 ? 12 : 10);
  return text + "\n";
}

// ---- Box plot ------------------------------------------------------------------------------------------------------

Layout box_plot_layout(const BoxPlot& plot) {
  const double row = row_height(plot.names.size());
  Layout layout;
  layout.left = 14 + widest_name(plot.names, std::min(12.0, row - 1.5)) + 8;
  layout.top = 40;
  layout.right = layout.left + 560;
  layout.bottom = layout.top + row * static_cast<double>(plot.names.size()) + 8;
  layout.width = layout.right + 24;
  layout.height = layout.bottom + 72;
  return with_words(layout, plot.title, plot.caption);
}

/// The boxes of those rows that have a value, by row.
std::vector<std::pair<std::size_t, BoxSummary>> boxes_of(const BoxPlot& plot) {
  std::vector<std::pair<std::size_t, BoxSummary>> boxes;
  for (std::size_t i = 0; i < plot.names.size(); ++i) {
    std::vector<double> values;
    for (std::size_t j = 0; j < plot.names.size(); ++j) values.push_back(plot.value(i, j));
    if (auto box = box_summary(std::move(values))) boxes.emplace_back(i, *std::move(box));
  }
  return boxes;
}

/// All that is drawn, and a little room on both sides.
std::array<double, 2> axis_range(const std::vector<std::pair<std::size_t, BoxSummary>>& boxes) {
  if (boxes.empty()) return {0, 1};
  std::array<double, 2> range{INFINITY, -INFINITY};
  const auto include = [&](double value) { range = {std::min(range[0], value), std::max(range[1], value)}; };
  for (const auto& [row, box] : boxes) {
    include(box.lower_whisker);
    include(box.upper_whisker);
    for (const double value : box.outliers) include(value);
    include(box.mean);
  }
  const double room = range[1] > range[0] ? 0.03 * (range[1] - range[0]) : 0.5;
  return {range[0] - room, range[1] + room};
}

std::string box_plot_axes(const BoxPlot& plot, const Layout& layout, const std::array<double, 2>& range) {
  const double row = row_height(plot.names.size());
  std::string text = fmt::format("set xrange [{}:{}]\nset yrange [{}:-0.7]\n", range[0], range[1],
                                 static_cast<double>(plot.names.size()) - 0.3);
  text += name_tics("ytics", plot.names, std::min(12.0, row - 1.5), "nomirror");
  text += "set border 3 lw 0.5 lc rgb '#666666'\n";
  text += "set grid xtics lt 1 lw 0.5 lc rgb '#dddddd'\n";
  text += "set xtics nomirror format '%g' scale 0.3 font ',12' textcolor rgb 'black'\n";
  text += fmt::format("set label {} at {},{} center font ',12'\n", text_literal(plot.unit),
                      layout.x((layout.left + layout.right) / 2), layout.y(layout.bottom + 40));
  text += fmt::format(
      "set label 'box: quartiles, median; whiskers: up to 1.5 interquartile ranges; circles: beyond; diamond: mean' "
      "at {},{} center font ',{}' textcolor rgb '#444444'\n",
      layout.x((layout.left + layout.right) / 2), layout.y(layout.bottom + 62), note_font);
  return text;
}

/// Two blocks of data and what draws them: whiskers, boxes, medians, outliers and means, the later ones on top.
std::string box_layers(const std::vector<std::pair<std::size_t, BoxSummary>>& boxes) {
  if (boxes.empty()) return std::string(nothing);
  std::string outliers;
  std::string text =
      "$BOXES << END_OF_BOXES\n# row mean median lower_quartile upper_quartile lower_whisker upper_whisker\n";
  for (const auto& [row, box] : boxes) {
    text += fmt::format("{} {} {} {} {} {} {}\n", row, box.mean, box.median, box.lower_quartile, box.upper_quartile,
                        box.lower_whisker, box.upper_whisker);
    for (const double value : box.outliers) outliers += fmt::format("{} {}\n", row, value);
  }
  text += "END_OF_BOXES\n";
  if (!outliers.empty()) text += "$OUTLIERS << END_OF_OUTLIERS\n" + outliers + "END_OF_OUTLIERS\n";
  text +=
      "half = 0.32\n"
      "plot $BOXES using 6:1:($4-$6):(0) with vectors nohead lw 1 lc rgb '#2b5c8a', \\\n"
      "     $BOXES using 5:1:($7-$5):(0) with vectors nohead lw 1 lc rgb '#2b5c8a', \\\n"
      "     $BOXES using 6:($1-half/2):(0):(half) with vectors nohead lw 1 lc rgb '#2b5c8a', \\\n"
      "     $BOXES using 7:($1-half/2):(0):(half) with vectors nohead lw 1 lc rgb '#2b5c8a', \\\n"
      "     $BOXES using 4:1:4:5:($1-half):($1+half) with boxxyerror fc rgb '#b8d4ea' lw 1 fs solid 1 "
      "border rgb '#2b5c8a', \\\n"
      "     $BOXES using 3:($1-half):(0):(2*half) with vectors nohead lw 2.5 lc rgb '#08306b', \\\n";
  if (!outliers.empty()) text += "     $OUTLIERS using 2:1 with points pt 6 ps 0.5 lw 1 lc rgb '#555555', \\\n";
  return text + "     $BOXES using 2:1 with points pt 13 ps 0.8 lc rgb '#d95f02'\n";
}

}  // namespace

std::string heat_map_script(const HeatMap& map, PictureFormat format) {
  check(map.names.size());
  const Layout layout = heat_map_layout(map);
  const auto range = colour_range(map);
  return opening(format, layout, map.title, map.caption) + heat_map_axes(map, layout, range) +
         heat_map_cells(map, range, format);
}

std::string box_plot_script(const BoxPlot& plot, PictureFormat format) {
  check(plot.names.size());
  const Layout layout = box_plot_layout(plot);
  const auto boxes = boxes_of(plot);
  return opening(format, layout, plot.title, plot.caption) + box_plot_axes(plot, layout, axis_range(boxes)) +
         box_layers(boxes);
}

void require_plotter(std::size_t strategies) {
  check(strategies);
  require_gnuplot();
}

void draw(const HeatMap& map, const fs::path& path) {
  draw_script(path, map.title, [&](PictureFormat format) { return heat_map_script(map, format); });
}

void draw(const BoxPlot& plot, const fs::path& path) {
  draw_script(path, plot.title, [&](PictureFormat format) { return box_plot_script(plot, format); });
}

}  // namespace folk
