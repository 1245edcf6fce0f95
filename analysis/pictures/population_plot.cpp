#include <folk/analysis/pictures/gnuplot_script.h>
#include <folk/analysis/pictures/population_plot.h>
#include <folk/games/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <numeric>
#include <string_view>

namespace folk {
namespace {

namespace fs = std::filesystem;
using namespace gnuplot;

/// Apart for every common colour vision (after Tol 2021, muted).
constexpr std::array<std::string_view, most_coloured> colours{"#332288", "#88ccee", "#44aa99", "#117733", "#999933",
                                                              "#ddcc77", "#cc6677", "#882255", "#aa4499", "#0072b2"};
constexpr std::string_view grey = "#bbbbbb";

/// More points than this cannot be told apart.
constexpr std::size_t most_points = 700;

/// More lines than this of those without a colour are not drawn.
constexpr std::size_t most_grey_lines = 60;

/// Longer ways have a logarithmic axis of generations: most happens early.
constexpr std::uint64_t long_way = 300;

/// Which rows are drawn: all where they are few, else as far apart as the axis shows them.
std::vector<std::size_t> drawn_rows(std::size_t count, const std::function<std::uint64_t(std::size_t)>& generation,
                                    bool logarithmic) {
  std::vector<std::size_t> chosen;
  const auto place = [&](std::size_t r) {
    const auto g = static_cast<double>(generation(r));
    return logarithmic ? std::log(g + 1) : g;
  };
  const double all = place(count - 1);
  double last = -INFINITY;
  for (std::size_t r = 0; r < count; ++r) {
    if (logarithmic && generation(r) == 0 && count > 1) continue;
    if (r + 1 < count && count > most_points && place(r) - last < all / most_points) continue;
    last = place(r);
    chosen.push_back(r);
  }
  return chosen;
}

struct Chosen {
  std::vector<std::size_t> coloured;  ///< in the order of the ranking
  std::vector<std::size_t> others;
};

/// The strategies that were most on average.
Chosen chosen_strategies(const PopulationPlot& plot) {
  std::vector<double> sums(plot.names.size(), 0);
  for (const auto& row : plot.rows)
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += row.population[i];
  std::vector<std::size_t> order = plot.ranking;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return sums[a] > sums[b]; });
  if (order.size() > most_coloured) order.resize(most_coloured);
  Chosen chosen;
  for (const std::size_t i : plot.ranking)
    (std::find(order.begin(), order.end(), i) != order.end() ? chosen.coloured : chosen.others).push_back(i);
  return chosen;
}

void check(const PopulationPlot& plot) {
  if (plot.names.empty() || plot.rows.empty())
    throw UsageError("a picture of a population needs strategies and generations");
  for (const auto& row : plot.rows)
    if (row.population.size() != plot.names.size())
      throw UsageError("a picture of a population: a generation has not as many numbers as there are strategies");
}

Layout layout_of(const std::string& title, const Caption& caption, double legend) {
  Layout layout;
  layout.left = 84;
  layout.right = layout.left + 560;
  layout.top = 44;
  layout.bottom = layout.top + 340;
  layout.width = layout.right + 24 + legend;
  layout.height = layout.bottom + 58;
  return with_words(layout, title, caption);
}

double legend_width(const PopulationPlot& plot, const Chosen& chosen) {
  std::vector<std::string> names{"1000 others"};
  for (const std::size_t i : chosen.coloured) names.push_back(plot.names[i]);
  return 44 + widest_name(names, text_font);
}

std::string way_axes(const Layout& layout, const std::string& unit, bool logarithmic, std::uint64_t last) {
  std::string text = "set border 3 lw 0.5 lc rgb '#666666'\nset grid lt 1 lw 0.5 lc rgb '#e4e4e4'\n";
  for (const char* axis : {"x", "y"})
    text += fmt::format("set {}tics nomirror scale 0.3 font ',{}' textcolor rgb 'black'\n", axis, text_font);
  if (logarithmic)
    text += fmt::format("set logscale x\nset xrange [1:{}]\n", last);
  else
    text += fmt::format("set xrange [0:{}]\n", std::max<std::uint64_t>(last, 1));
  text += fmt::format("set label 'generation' at {},{} center font ',{}'\n", layout.x((layout.left + layout.right) / 2),
                      layout.y(layout.bottom + 40), text_font);
  text += fmt::format("set label {} at {},{} rotate by 90 center font ',{}'\n", text_literal(unit), layout.x(22),
                      layout.y((layout.top + layout.bottom) / 2), text_font);
  return text;
}

std::string legend(const Layout& layout, PictureFormat format) {
  return fmt::format("set key at {},{} left top Left reverse samplen 1.5 spacing {} font ',{}'\n",
                     layout.x(layout.right + 10), layout.y(layout.top), format == PictureFormat::svg ? 1.0 : 1.25,
                     text_font);
}

/// Numbers beside the axis; millions as 2.5M, for which there is room.
std::string_view tics_format(bool shares, double most) { return shares ? "%g" : most < 1e6 ? "%.0f" : "%.1s%c"; }

std::string others_name(std::size_t count) { return fmt::format("{} other{}", count, count == 1 ? "" : "s"); }

/// What the rows of both pictures share.
struct Way {
  explicit Way(const PopulationPlot& plot)
      : logarithmic(plot.rows.back().generation > long_way),
        rows(drawn_rows(
            plot.rows.size(), [&](std::size_t r) { return plot.rows[r].generation; }, logarithmic)),
        chosen(chosen_strategies(plot)),
        layout(layout_of(plot.title, plot.caption, legend_width(plot, chosen))) {}

  bool logarithmic;
  std::vector<std::size_t> rows;
  Chosen chosen;
  Layout layout;
};

}  // namespace

std::string population_lines_script(const PopulationPlot& plot, PictureFormat format) {
  check(plot);
  const Way way(plot);
  double most = 0;
  double least = plot.shares ? INFINITY : 1;
  for (const auto& row : plot.rows)
    for (const double number : row.population) {
      most = std::max(most, number);
      if (number > 0) least = std::min(least, number);
    }
  least = plot.shares ? std::clamp(least, 1e-6, 0.5) : 1;
  std::string text =
      opening(format, way.layout, plot.title, plot.caption) +
      way_axes(way.layout, plot.shares ? "share" : "individuals", way.logarithmic, plot.rows.back().generation) +
      legend(way.layout, format);
  text += fmt::format("set logscale y\nset yrange [{}:{}]\nset ytics format '{}'\n", least * 0.8,
                      std::max(most * 1.3, least * 2), tics_format(plot.shares, most));
  std::vector<std::size_t> drawn = way.chosen.others;
  if (drawn.size() > most_grey_lines) drawn.resize(most_grey_lines);
  const std::size_t in_grey = drawn.size();
  drawn.insert(drawn.end(), way.chosen.coloured.begin(), way.chosen.coloured.end());
  fmt::memory_buffer data;
  for (const std::size_t r : way.rows) {
    fmt::format_to(std::back_inserter(data), "{}", plot.rows[r].generation);
    for (const std::size_t i : drawn) {
      const double number = plot.rows[r].population[i];
      // What is not there has no logarithm: the line ends.
      if (number >= least * 0.8)
        fmt::format_to(std::back_inserter(data), " {}", number);
      else
        fmt::format_to(std::back_inserter(data), " NaN");
    }
    data.push_back('\n');
  }
  text += "$WAY << END_OF_WAY\n" + fmt::to_string(data) + "END_OF_WAY\n";
  std::vector<std::string> layers;
  for (std::size_t k = 0; k < in_grey; ++k)
    layers.push_back(fmt::format("$WAY using 1:{} with lines lw 0.7 lc rgb '{}' notitle", k + 2, grey));
  for (std::size_t k = in_grey; k < drawn.size(); ++k)
    layers.push_back(fmt::format("$WAY using 1:{} with lines lw 2 lc rgb '{}' title {}", k + 2, colours[k - in_grey],
                                 name_literal(plot.names[drawn[k]])));
  if (in_grey > 0)
    layers.push_back(fmt::format("NaN with lines lw 0.7 lc rgb '{}' title {}", grey,
                                 text_literal(others_name(way.chosen.others.size()))));
  return text + fmt::format("plot {}\n", fmt::join(layers, ", \\\n     "));
}

std::string population_stack_script(const PopulationPlot& plot, PictureFormat format) {
  check(plot);
  const Way way(plot);
  double most = 0;
  fmt::memory_buffer data;
  for (const std::size_t r : way.rows) {
    const auto& population = plot.rows[r].population;
    fmt::format_to(std::back_inserter(data), "{} 0", plot.rows[r].generation);
    double sum = 0;
    for (auto i = way.chosen.coloured.rbegin(); i != way.chosen.coloured.rend(); ++i) {
      sum += population[*i];
      fmt::format_to(std::back_inserter(data), " {}", sum);
    }
    for (const std::size_t i : way.chosen.others) sum += population[i];
    fmt::format_to(std::back_inserter(data), " {}\n", sum);
    most = std::max(most, sum);
  }
  std::string text =
      opening(format, way.layout, plot.title, plot.caption) +
      way_axes(way.layout, plot.shares ? "share" : "individuals", way.logarithmic, plot.rows.back().generation) +
      legend(way.layout, format);
  text += fmt::format("set yrange [0:{}]\nset ytics format '{}'\n$WAY << END_OF_WAY\n{}END_OF_WAY\n",
                      most > 0 ? most : 1, tics_format(plot.shares, most), fmt::to_string(data));
  std::vector<std::string> layers;
  const std::size_t count = way.chosen.coloured.size();
  const auto area = [](std::size_t column, std::string_view colour, const std::string& title) {
    return fmt::format("$WAY using 1:{}:{} with filledcurves fc rgb '{}' fs solid 1 noborder title {}", column,
                       column + 1, colour, title);
  };
  // The legend from the top of the stack down.
  if (!way.chosen.others.empty())
    layers.push_back(area(count + 2, grey, text_literal(others_name(way.chosen.others.size()))));
  for (std::size_t k = 0; k < count; ++k)
    layers.push_back(area(count + 1 - k, colours[k], name_literal(plot.names[way.chosen.coloured[k]])));
  return text + fmt::format("plot {}\n", fmt::join(layers, ", \\\n     "));
}

std::string cooperation_script(const CooperationPlot& plot, PictureFormat format) {
  if (plot.shares.empty()) throw UsageError("a picture of cooperation needs a generation");
  const std::uint64_t last = plot.shares.back().first;
  const bool logarithmic = last > long_way;
  const Layout layout = layout_of(plot.title, plot.caption, 0);
  std::string text =
      opening(format, layout, plot.title, plot.caption) + way_axes(layout, "cooperation, %", logarithmic, last);
  text += "set yrange [0:100]\n$WAY << END_OF_WAY\n";
  for (const std::size_t r : drawn_rows(
           plot.shares.size(), [&](std::size_t i) { return plot.shares[i].first; }, logarithmic))
    text += fmt::format("{} {}\n", plot.shares[r].first, 100 * plot.shares[r].second);
  return text + fmt::format("END_OF_WAY\nplot $WAY using 1:2 with {} lw 2 lc rgb '#2b5c8a' notitle\n",
                            plot.shares.size() == 1 ? "points pt 7" : "lines");
}

void draw_lines(const PopulationPlot& plot, const fs::path& path) {
  draw_script(path, plot.title, [&](PictureFormat format) { return population_lines_script(plot, format); });
}

void draw_stack(const PopulationPlot& plot, const fs::path& path) {
  draw_script(path, plot.title, [&](PictureFormat format) { return population_stack_script(plot, format); });
}

void draw(const CooperationPlot& plot, const fs::path& path) {
  draw_script(path, plot.title, [&](PictureFormat format) { return cooperation_script(plot, format); });
}

}  // namespace folk
