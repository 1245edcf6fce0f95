#include <folk/analysis/pictures/invasion_drawing.h>
#include <folk/analysis/pictures/invasion_matrix.h>
#include <folk/analysis/pictures/matrix_frame.h>
#include <folk/analysis/pictures/plots.h>
#include <folk/games/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <tuple>

namespace folk {
namespace {

using gnuplot::Layout;

/// Dark, light and pale also in grey.
std::string_view cell_colour(Invasion invasion) {
  switch (invasion) {
    case Invasion::strictly: return "#b2182b";
    case Invasion::weakly: return "#f4a582";
    case Invasion::resists: return "#f3f3f3";
    case Invasion::undecided: break;
  }
  return "#a6a6a6";
}

constexpr double strip_gap = 8;  // between the matrix and the strip of stability
constexpr double matrix_legend_row = 20;

double strip_height(std::size_t strategies) { return std::max(12.0, gnuplot::cell_size(strategies)); }

/// An entry of the legend: a colour and what it means.
struct Swatch {
  std::string_view colour;
  std::string_view meaning;
};

/// Lines of the legend; what does not occur is not in it.
std::vector<std::vector<Swatch>> legend_of(const Invasions& invasions) {
  std::vector<std::vector<Swatch>> lines(2);
  bool undecided = false;
  for (std::size_t i = 0; i < invasions.size(); ++i)
    undecided = undecided || !invasions.mutants(i, Invasion::undecided).empty();
  lines[0] = {{cell_colour(Invasion::strictly), "invades strictly"},
              {cell_colour(Invasion::weakly), "weakly: drifts in"},
              {cell_colour(Invasion::resists), "is resisted"}};
  if (undecided) lines[0].push_back({cell_colour(Invasion::undecided), "undecided"});
  for (const auto stability :
       {Stability::evolutionarily_stable, Stability::neutrally_stable, Stability::undecided, Stability::invaded})
    for (std::size_t i = 0; i < invasions.size(); ++i)
      if (invasions.stability(i) == stability) {
        lines[1].push_back({stability_colour(stability), to_string(stability)});
        break;
      }
  return lines;
}

double legend_width(const std::vector<Swatch>& line) {
  double width = 0;
  for (const auto& swatch : line) width += 18 + gnuplot::text_width(swatch.meaning, gnuplot::note_font) + 14;
  return width;
}

constexpr double legend_words = 62;  // "matrix:", "strip:"

Layout invasion_layout(const Invasions& invasions, const std::vector<std::string>& names, const std::string& title,
                       const Caption& caption) {
  Layout layout = gnuplot::matrix_layout(names);
  const auto legend = legend_of(invasions);
  layout.height = layout.bottom + strip_gap + strip_height(names.size()) + 12 +
                  matrix_legend_row * static_cast<double>(legend.size()) + 4;
  for (const auto& line : legend) layout.width = std::max(layout.width, 14 + legend_words + legend_width(line));
  return gnuplot::with_words(layout, title, caption);
}

std::string rectangle_at(const Layout& layout, double left, double top, double right, double bottom,
                         std::string_view colour) {
  return fmt::format(
      "set object rectangle from {},{} to {},{} front fillcolor rgb '{}' fillstyle solid 1 border lc rgb '#999999' lw "
      "0.5\n",
      layout.x(left), layout.y(top), layout.x(right), layout.y(bottom), colour);
}

std::string legend_text(const Layout& layout, const Invasions& invasions, double top) {
  std::string text;
  double y = top + matrix_legend_row / 2;
  constexpr std::array<std::string_view, 2> words{"matrix:", "strip:"};
  const auto legend = legend_of(invasions);
  for (std::size_t i = 0; i < legend.size(); ++i) {
    double x = 14;
    text += fmt::format("set label '{}' at {},{} left font ',{}' textcolor rgb '#444444'\n", words[i], layout.x(x),
                        layout.y(y), gnuplot::note_font);
    x += legend_words;
    for (const auto& [colour, meaning] : legend[i]) {
      text += rectangle_at(layout, x, y - 6, x + 12, y + 6, colour);
      text += fmt::format("set label '{}' at {},{} left font ',{}'\n", meaning, layout.x(x + 18), layout.y(y),
                          gnuplot::note_font);
      x += 18 + gnuplot::text_width(meaning, gnuplot::note_font) + 14;
    }
    y += matrix_legend_row;
  }
  return text;
}

/// How stable each resident is, a strip below its column; runs of one colour are one rectangle.
std::string stability_strip(const Layout& layout, const Invasions& invasions, const std::vector<std::size_t>& order) {
  const double cell = gnuplot::cell_size(order.size());
  const double top = layout.bottom + strip_gap;
  std::string text;
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    const Stability stability = invasions.stability(order[begin]);
    while (end < order.size() && invasions.stability(order[end]) == stability) ++end;
    text += rectangle_at(layout, layout.left + cell * static_cast<double>(begin), top,
                         layout.left + cell * static_cast<double>(end), top + strip_height(order.size()),
                         stability_colour(stability));
  }
  return text + fmt::format("set label 'stability' at {},{} right font ',{}' textcolor rgb '#444444'\n",
                            layout.x(layout.left - 6), layout.y(top + strip_height(order.size()) / 2),
                            gnuplot::note_font);
}

/// "left right row colour" a line. Cells with lines around them stand each by itself; of more strategies runs of one
/// colour are one, so that the picture stays small.
std::string matrix_cells(const Invasions& invasions, const std::vector<std::size_t>& order) {
  const std::size_t n = order.size();
  std::string cells = "$CELLS << END_OF_CELLS\n";
  std::string unknown;
  for (std::size_t row = 0; row < n; ++row)
    for (std::size_t begin = 0, end = 0; begin < n; begin = end) {
      const auto how = [&](std::size_t column) { return invasions.invasion(order[row], order[column]); };
      end = begin + 1;
      if (begin == row) continue;  // itself
      if (n > gnuplot::most_lined)
        while (end < n && end != row && how(end) == how(begin)) ++end;
      cells += fmt::format("{} {} {} 0x{}\n", static_cast<double>(begin) - 0.5, static_cast<double>(end) - 0.5, row,
                           cell_colour(how(begin)).substr(1));
      if (how(begin) == Invasion::undecided && n <= gnuplot::most_lined)
        unknown += fmt::format("{} {} ?\n", begin, row);
    }
  cells += "END_OF_CELLS\n";
  if (n == 1) return "plot -9 notitle\n";
  const std::string_view border = n > gnuplot::most_lined ? "noborder" : "border rgb 'white'";
  std::string plot = fmt::format(
      "plot $CELLS using (($1+$2)/2):3:1:2:($3-0.5):($3+0.5):4 with boxxyerror lc rgb variable lw 0.5 fillstyle solid "
      "1 "
      "{}",
      border);
  if (!unknown.empty()) {
    cells += "$UNKNOWN << END_OF_UNKNOWN\n" + unknown + "END_OF_UNKNOWN\n";
    plot += ", \\\n     $UNKNOWN using 1:2:3 with labels font ',11'";
  }
  return cells + plot + "\n";
}

int stability_rank(Stability stability) {
  switch (stability) {
    case Stability::evolutionarily_stable: return 0;
    case Stability::neutrally_stable: return 1;
    case Stability::undecided: return 2;
    case Stability::invaded: break;
  }
  return 3;
}

}  // namespace

std::vector<std::size_t> invasion_order(const Invasions& invasions) {
  using Key = std::tuple<int, std::size_t, std::ptrdiff_t, std::size_t>;
  std::vector<std::ptrdiff_t> conquests(invasions.size());
  std::vector<std::size_t> invaders(invasions.size());
  for (std::size_t resident = 0; resident < invasions.size(); ++resident)
    for (const std::size_t mutant : invasions.mutants(resident, Invasion::strictly)) {
      ++invaders[resident];
      ++conquests[mutant];
    }
  std::vector<Key> keys;
  for (std::size_t i = 0; i < invasions.size(); ++i)
    keys.emplace_back(stability_rank(invasions.stability(i)), invaders[i], -conquests[i], i);
  std::sort(keys.begin(), keys.end());
  std::vector<std::size_t> order;
  for (const auto& key : keys) order.push_back(std::get<3>(key));
  return order;
}

std::string invasion_matrix_script(const Invasions& invasions, const std::vector<std::string>& names,
                                   const std::string& title, const Caption& caption, PictureFormat format) {
  if (names.empty() || names.size() != invasions.size())
    throw UsageError(
        fmt::format("a matrix of invasions among {} strategies has {} names", invasions.size(), names.size()));
  if (names.size() > most_plotted)
    throw UsageError(
        fmt::format("{} strategies are too many for a matrix of invasions: at most {}", names.size(), most_plotted));
  const auto order = invasion_order(invasions);
  std::vector<std::string> ordered;
  for (const std::size_t i : order) ordered.push_back(names[i]);
  const Layout layout = invasion_layout(invasions, ordered, title, caption);
  const double legend_top = layout.bottom + strip_gap + strip_height(names.size()) + 12;
  return gnuplot::opening(format, layout, title, caption) +
         gnuplot::matrix_axes(layout, ordered, "mutant", "resident") + stability_strip(layout, invasions, order) +
         legend_text(layout, invasions, legend_top) + matrix_cells(invasions, order);
}

}  // namespace folk
