#include <folk/analysis/pictures/gnuplot_script.h>
#include <folk/analysis/pictures/simplex_plot.h>
#include <folk/games/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace folk {
namespace {

namespace fs = std::filesystem;
using namespace gnuplot;

/// Arrows along an edge.
constexpr int grid = 16;

std::array<double, 2> place(const Mixture& p) { return {p[1] + p[2] / 2, p[2] * std::sqrt(3.0) / 2}; }

}  // namespace

Mixture replicator_velocity(const std::array<std::array<double, 3>, 3>& payoffs, const Mixture& p) {
  Mixture f{};
  double phi = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) f[i] += payoffs[i][j] * p[j];
    phi += p[i] * f[i];
  }
  Mixture velocity{};
  for (std::size_t i = 0; i < 3; ++i) velocity[i] = p[i] * (f[i] - phi);
  return velocity;
}

std::string simplex_script(const SimplexPlot& plot, PictureFormat format) {
  double largest = 0;
  for (const auto& row : plot.payoffs)
    for (const double payoff : row) {
      if (!std::isfinite(payoff)) throw UsageError("a picture of a simplex has a payoff that is not finite");
      largest = std::max(largest, std::abs(payoff));
    }
  const double still = 1e-9 * std::max(largest, 1e-300);  // slower is rest

  std::string arrows;
  std::string rests;
  double fastest = 0;
  constexpr double length = 0.62 / grid;
  for (int a = 0; a <= grid; ++a)
    for (int b = 0; a + b <= grid; ++b) {
      const Mixture p{static_cast<double>(grid - a - b) / grid, static_cast<double>(a) / grid,
                      static_cast<double>(b) / grid};
      const Mixture velocity = replicator_velocity(plot.payoffs, p);
      const auto [x, y] = place(p);
      const auto [dx, dy] = place(velocity);
      const double speed = std::hypot(dx, dy);
      if (speed <= still) {
        rests += fmt::format("{} {}\n", x, y);
        continue;
      }
      fastest = std::max(fastest, speed);
      arrows += fmt::format("{} {} {} {} {}\n", x - length / 2 * dx / speed, y - length / 2 * dy / speed,
                            length * dx / speed, length * dy / speed, speed);
    }

  Layout layout;
  layout.left = 70;
  layout.right = layout.left + 520;
  layout.top = 70;
  layout.bottom = layout.top + 520 * std::sqrt(3.0) / 2;
  layout.width = layout.right + 110;
  layout.height = layout.bottom + 78;
  const double note = layout.height - 18;
  layout = with_words(layout, plot.title, plot.caption);

  std::string text = opening(format, layout, plot.title, plot.caption);
  text += "set xrange [0:1]\nset yrange [0:sqrt(3)/2]\nunset border\nunset tics\n";
  text += "set palette defined (0 '#c6dbef', 0.5 '#4292c6', 1 '#08306b')\n";
  text += fmt::format("set cbrange [0:{}]\n", fastest > 0 ? fastest : 1);
  text += fmt::format("set colorbox user origin {},{} size {},{}\n", layout.x(layout.right + 30),
                      layout.y(layout.top + 200), layout.x(12), fmt::format("screen {:.6f}", 150 / layout.height));
  text += fmt::format("set cbtics ('slow' 0, 'fast' {}) scale 0 font ',{}'\n", fastest > 0 ? fastest : 1, note_font);
  text += "set object polygon from 0,0 to 1,0 to 0.5,sqrt(3)/2 to 0,0 fs empty border lc rgb '#666666' lw 1\n";
  text += fmt::format("set label {} at 0,0 center offset 0,-1.2 font ',{}'\n", name_literal(plot.names[0]), text_font);
  text += fmt::format("set label {} at 1,0 center offset 0,-1.2 font ',{}'\n", name_literal(plot.names[1]), text_font);
  text += fmt::format("set label {} at 0.5,sqrt(3)/2 center offset 0,1.0 font ',{}'\n", name_literal(plot.names[2]),
                      text_font);
  text += fmt::format(
      "set label 'arrows: where the replicator equation leads; rings: nothing changes{}' at {},{} center font ',{}' "
      "textcolor rgb '#444444'\n",
      plot.way.empty() ? "" : "; line: the population, its end a dot", layout.x((layout.left + layout.right) / 2),
      layout.y(note), note_font);
  std::vector<std::string> layers;
  if (!arrows.empty()) {
    text += "$ARROWS << END_OF_ARROWS\n" + arrows + "END_OF_ARROWS\n";
    layers.emplace_back("$ARROWS using 1:2:3:4:5 with vectors filled size screen 0.010,18 lw 1.2 lc palette notitle");
  }
  if (!rests.empty()) {
    text += "$RESTS << END_OF_RESTS\n" + rests + "END_OF_RESTS\n";
    layers.emplace_back("$RESTS using 1:2 with points pt 6 ps 0.5 lw 1 lc rgb '#888888' notitle");
  }
  if (!plot.way.empty()) {
    text += "$WAY << END_OF_WAY\n";
    for (const auto& mixture : plot.way) {
      const auto [x, y] = place(mixture);
      text += fmt::format("{} {}\n", x, y);
    }
    const auto [x, y] = place(plot.way.back());
    text += fmt::format("END_OF_WAY\n$GOAL << END_OF_GOAL\n{} {}\nEND_OF_GOAL\n", x, y);
    layers.emplace_back("$WAY using 1:2 with lines lw 2.5 lc rgb '#d95f02' notitle");
    layers.emplace_back("$GOAL using 1:2 with points pt 7 ps 1 lc rgb '#d95f02' notitle");
  }
  return text + fmt::format("plot {}\n", fmt::join(layers, ", \\\n     "));
}

void draw(const SimplexPlot& plot, const fs::path& path) {
  draw_script(path, plot.title, [&](PictureFormat format) { return simplex_script(plot, format); });
}

}  // namespace folk
