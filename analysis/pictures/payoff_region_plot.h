#pragma once
// The picture of a payoff region: what is feasible, what is individually rational, what is an equilibrium.

#include <folk/analysis/folk_theorem/convex_polygon.h>
#include <folk/analysis/pictures/caption.h>
#include <folk/analysis/pictures/render.h>

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace folk {

/// What is drawn; each set by its corners, one corner a point and two a segment.
struct PayoffRegionPlot {
  std::string title;
  std::array<std::string, 2> players;  ///< their payoffs are the axes, the row seat's first
  Polygon<double> feasible;            ///< at least one corner
  Polygon<double> individually_rational;
  std::optional<Polygon<double>> equilibria;  ///< nothing: not asked for; no corner: there is none
  std::string equilibria_name;                ///< for the legend: "equilibria at d = 0.9"
  Point<double> pure_minmax{};
  Point<double> mixed_minmax{};

  /// What a pure profile pays, with a name.
  struct Outcome {
    std::string name;  ///< "C, D"
    Point<double> payoffs{};
  };
  std::vector<Outcome> outcomes;  ///< those to be named; may be none

  std::vector<Point<double>> dots;
  std::string dots_name;  ///< for the legend: "pairs of classics"

  Caption caption{};
};

/// The whole gnuplot script, data included, that draws into `output` (any path; nothing in a name or a path is
/// executed). Dots that would fall on each other are drawn once.
/// Throws UsageError on a path with a control character, an empty feasible set, or a number that is not finite.
std::string payoff_region_script(const PayoffRegionPlot& plot, PictureFormat format);

/// Draws to a file whose extension is .svg, .png or .pdf; a failure leaves no half picture. Throws as
/// payoff_region_script and gnuplot::draw_script do.
void draw(const PayoffRegionPlot& plot, const std::filesystem::path& path);

}  // namespace folk
