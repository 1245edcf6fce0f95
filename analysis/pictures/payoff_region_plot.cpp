#include <folk/analysis/pictures/gnuplot_script.h>
#include <folk/analysis/pictures/payoff_region_plot.h>
#include <folk/games/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace folk {
namespace {

namespace fs = std::filesystem;
using namespace gnuplot;

using Shape = Polygon<double>;

/// Where the axes begin and end: all that is drawn, and a little room.
using Range = std::array<double, 2>;

Range axis_range(const PayoffRegionPlot& plot, std::size_t axis) {
  Range range{INFINITY, -INFINITY};
  const auto include = [&](const Point<double>& point) {
    if (!std::isfinite(point[axis])) throw UsageError("a payoff region's picture has a payoff that is not finite");
    range = {std::min(range[0], point[axis]), std::max(range[1], point[axis])};
  };
  for (const auto& corner : plot.feasible) include(corner);
  for (const auto& dot : plot.dots) include(dot);
  include(plot.pure_minmax);  // it may lie outside the feasible set
  include(plot.mixed_minmax);
  const double room = range[1] > range[0] ? 0.08 * (range[1] - range[0]) : 0.5;
  return {range[0] - room, range[1] + room};
}

/// The height of a line of the legend.
constexpr double legend_row = 18.5;

std::size_t legend_entries(const PayoffRegionPlot& plot) {
  return 4U + (plot.equilibria ? 1U : 0U) + (plot.dots.empty() ? 0U : 1U);
}

Layout layout_of(const PayoffRegionPlot& plot) {
  Layout layout;
  layout.left = 78;
  layout.right = layout.left + 520;
  layout.top = 44;
  layout.bottom = layout.top + 440;
  layout.width = layout.right + 24;
  layout.height = layout.bottom + 56 + legend_row * static_cast<double>(legend_entries(plot)) + 12;
  return with_words(layout, plot.title, plot.caption);
}

std::string axes(const PayoffRegionPlot& plot, const Layout& layout, PictureFormat format) {
  const Range x = axis_range(plot, 0);
  const Range y = axis_range(plot, 1);
  std::string text = fmt::format("set xrange [{}:{}]\nset yrange [{}:{}]\n", x[0], x[1], y[0], y[1]);
  text += "set border 3 lw 0.5 lc rgb '#666666'\nset grid lt 1 lw 0.5 lc rgb '#e4e4e4'\n";
  for (const char* axis : {"x", "y"})
    text +=
        fmt::format("set {}tics nomirror format '%g' scale 0.3 font ',{}' textcolor rgb 'black'\n", axis, text_font);
  text += fmt::format("set label {} at {},{} center font ',{}'\n",
                      text_literal(fitted("payoff of " + plot.players[0], text_font, layout.right - layout.left)),
                      layout.x((layout.left + layout.right) / 2), layout.y(layout.bottom + 40), text_font);
  text += fmt::format("set label {} at {},{} rotate by 90 center font ',{}'\n",
                      text_literal(fitted("payoff of " + plot.players[1], text_font, layout.bottom - layout.top)),
                      layout.x(22), layout.y((layout.top + layout.bottom) / 2), text_font);
  text += fmt::format("set key at {},{} left top Left reverse samplen 2 spacing {} font ',{}'\n",
                      layout.x(layout.left - 20), layout.y(layout.bottom + 56),
                      format == PictureFormat::svg ? 1.0 : 1.25, text_font);  // a line is higher in SVG
  return text;
}

/// A block of data: a line a point.
std::string block(const std::string& name, const std::vector<Point<double>>& points) {
  std::string text = fmt::format("${0} << END_OF_{0}\n", name);
  for (const auto& [x, y] : points) text += fmt::format("{} {}\n", x, y);
  return text + fmt::format("END_OF_{}\n", name);
}

/// How a set is drawn.
struct Look {
  std::string fill;  ///< colour, or nothing for the outline alone
  std::string line;
  double width = 1;
  std::string dash = "1";  ///< gnuplot's dash type
};

/// The data of a set and the parts of a plot command that draw it, its name in the legend once.
struct DrawnSets {
  std::string data;
  std::vector<std::string> layers;

  void add_set(const std::string& block_name, Shape set, const std::string& name, const Look& look) {
    const std::size_t corners = set.size();
    if (corners == 0) {
      layers.push_back(fmt::format("NaN with points pt 0 title {}", text_literal(name)));
      return;
    }
    set.push_back(set.front());
    data += block(block_name, set);
    std::string title = name.empty() ? "notitle" : "title " + text_literal(name);
    if (corners > 2 && !look.fill.empty()) {
      layers.push_back(
          fmt::format("${} using 1:2 with filledcurves closed fc rgb '{}' fs solid 1 border lc rgb '{}' {}", block_name,
                      look.fill, look.line, title));
      title = "notitle";
    }
    // A segment or a point would hide behind the outlines of larger sets.
    const double width = corners > 2 || look.fill.empty() ? look.width : 3 * look.width;
    layers.push_back(fmt::format("${} using 1:2 with lines lw {} dt {} lc rgb '{}' {}", block_name, width, look.dash,
                                 look.line, title));
    if (corners == 1)
      layers.push_back(fmt::format("${} using 1:2 with points pt 7 ps 1 lc rgb '{}' notitle", block_name, look.line));
  }

  void add_points(const std::string& block_name, const std::vector<Point<double>>& points, const std::string& name,
                  const std::string& style) {
    data += block(block_name, points);
    layers.push_back(fmt::format("${} using 1:2 with points {} title {}", block_name, style, text_literal(name)));
  }
};

/// Of dots that fall on the same spot (a 2000th of the axes) the first.
std::vector<Point<double>> distinct_dots(const PayoffRegionPlot& plot) {
  const Range x = axis_range(plot, 0);
  const Range y = axis_range(plot, 1);
  std::set<std::array<long, 2>> spots;
  std::vector<Point<double>> kept;
  for (const auto& dot : plot.dots)
    if (spots
            .insert({std::lround(2000 * (dot[0] - x[0]) / (x[1] - x[0])),
                     std::lround(2000 * (dot[1] - y[0]) / (y[1] - y[0]))})
            .second)
      kept.push_back(dot);
  return kept;
}

/// True where the sign of a minmax point would cover what is written close to these payoffs.
bool under_a_sign(const PayoffRegionPlot& plot, const Layout& layout, const Point<double>& payoffs) {
  constexpr double size = 12;  // pixels
  const Range x = axis_range(plot, 0);
  const Range y = axis_range(plot, 1);
  const auto near = [&](const Point<double>& sign) {
    return std::abs(sign[0] - payoffs[0]) / (x[1] - x[0]) * (layout.right - layout.left) < size &&
           std::abs(sign[1] - payoffs[1]) / (y[1] - y[0]) * (layout.bottom - layout.top) < size;
  };
  return near(plot.pure_minmax) || near(plot.mixed_minmax);
}

/// The names of profiles: outside the region where all are short enough for the room there, else inside.
std::string outcome_labels(const PayoffRegionPlot& plot, const Layout& layout) {
  constexpr double room = 46;  // pixels beside the outermost profile
  std::vector<std::string> names;
  for (const auto& outcome : plot.outcomes) names.push_back(outcome.name);
  const bool outside = widest_name(names, note_font) <= room;
  const double most = 0.45 * (layout.right - layout.left);  // inside it then ends before the frame does
  const Range x = axis_range(plot, 0);
  const Range y = axis_range(plot, 1);
  std::string text;
  for (const auto& [name, payoffs] : plot.outcomes) {
    const bool in_left_half = payoffs[0] < (x[0] + x[1]) / 2;
    const bool ends_at_point = in_left_half == outside;
    const bool covered = under_a_sign(plot, layout, payoffs);
    const double aside = covered ? 1.5 : 0.5;
    const double above = covered ? 0.9 : 0.6;
    text += fmt::format(
        "set label {} at first {},{} {} offset character {},{} front font ',{}' textcolor rgb '#444444' "
        "point pt 7 ps 0.35 lc rgb '#444444'\n",
        text_literal(fitted(name, note_font, most)), payoffs[0], payoffs[1], ends_at_point ? "right" : "left",
        ends_at_point ? -aside : aside, payoffs[1] < (y[0] + y[1]) / 2 ? -above : above, note_font);
  }
  return text;
}

}  // namespace

std::string payoff_region_script(const PayoffRegionPlot& plot, PictureFormat format) {
  if (plot.feasible.empty()) throw UsageError("a payoff region's picture needs a feasible payoff");
  const Layout layout = layout_of(plot);
  DrawnSets drawing;
  drawing.add_set("FEASIBLE", plot.feasible, "feasible", {"#f2f2f2", "#8c8c8c", 1, "1"});
  drawing.add_set("RATIONAL", plot.individually_rational, "individually rational (mixed minmax)",
                  {"#d3e5f3", "#6a9cc4", 1, "1"});
  if (plot.equilibria)
    drawing.add_set("EQUILIBRIA", *plot.equilibria, plot.equilibria_name, {"#7fb3d9", "#08519c", 1.5, "1"});
  drawing.add_set("OUTLINE", plot.individually_rational, {}, {"", "#6a9cc4", 1, "3"});
  if (!plot.dots.empty())
    drawing.add_points("DOTS", distinct_dots(plot), plot.dots_name, "pt 7 ps 0.4 lc rgb '#222222'");
  drawing.add_points("PURE", {plot.pure_minmax}, "pure minmax point", "pt 4 ps 1.3 lw 2 lc rgb '#d95f02'");
  drawing.add_points("MIXED", {plot.mixed_minmax}, "mixed minmax point", "pt 2 ps 1 lw 2 lc rgb '#b2182b'");
  return opening(format, layout, plot.title, plot.caption) + axes(plot, layout, format) + outcome_labels(plot, layout) +
         drawing.data + fmt::format("plot {}\n", fmt::join(drawing.layers, ", \\\n     "));
}

void draw(const PayoffRegionPlot& plot, const fs::path& path) {
  draw_script(path, plot.title, [&](PictureFormat format) { return payoff_region_script(plot, format); });
}

}  // namespace folk
