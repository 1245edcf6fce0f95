#include <folk/tools/choices/game_option.h>
#include <folk/tools/payoff_region/output.h>

#include <fmt/format.h>
#include <folk/analysis/pictures/payoff_region_plot.h>

#include <algorithm>

namespace folk::tools {
namespace {

/// Profiles are named in the picture of a game of at most so many.
constexpr std::size_t most_named = 9;

Point<double> numbers(const Point<Rational>& point) { return {to_double(point[0]), to_double(point[1])}; }

Polygon<double> numbers(const Polygon<Rational>& polygon) {
  Polygon<double> corners(polygon.size());
  std::transform(polygon.begin(), polygon.end(), corners.begin(),
                 [](const Point<Rational>& corner) { return numbers(corner); });
  return corners;
}

/// The profiles, those that pay the same as one.
std::vector<PayoffRegionPlot::Outcome> outcomes_of(const StageGame& game) {
  std::vector<PayoffRegionPlot::Outcome> outcomes;
  if (game.rows() * game.columns() > most_named) return outcomes;
  for (std::size_t i = 0; i < game.rows(); ++i)
    for (std::size_t j = 0; j < game.columns(); ++j) {
      const auto payoffs = numbers({game.payoff(Seat::first, i, j), game.payoff(Seat::second, i, j)});
      const auto name = fmt::format("{}, {}", game.actions(Seat::first)[i], game.actions(Seat::second)[j]);
      const auto same = std::find_if(outcomes.begin(), outcomes.end(),
                                     [&](const auto& outcome) { return outcome.payoffs == payoffs; });
      if (same != outcomes.end())
        same->name += " and " + name;
      else
        outcomes.push_back({name, payoffs});
    }
  return outcomes;
}

}  // namespace

void draw_picture(const std::filesystem::path& path, const RegionReport& report) {
  PayoffRegionPlot plot;
  plot.title = fmt::format("{}: payoffs a round", shown_title(report.title));
  plot.players = shown_players(report.game);
  plot.feasible = numbers(report.region.feasible);
  plot.individually_rational = numbers(report.region.individually_rational);
  plot.pure_minmax = numbers(report.region.pure_minmax());
  plot.mixed_minmax = numbers(report.region.mixed_minmax());
  plot.outcomes = outcomes_of(report.game);
  plot.caption.game = shown_title(report.title);
  if (report.set) {
    plot.caption.criterion = Criterion::discounted(report.set->discount).to_string();
    plot.equilibria = report.set->corners;
    plot.equilibria_name = fmt::format("{}pure-strategy equilibria at d = {}", report.set->corners.empty() ? "no " : "",
                                       report.set->discount);
  }
  if (report.tournament) {
    const std::string pairs = "pairs " + report.tournament->criterion;
    plot.caption.criterion += plot.caption.criterion.empty() ? pairs : ", " + pairs;
    plot.caption.noise = report.tournament->noise;
    for (const auto& pair : report.tournament->pairs) plot.dots.push_back(pair.payoffs);
    plot.dots_name = fmt::format("{} pairs of a tournament", report.tournament->pairs.size());
  }
  draw(plot, path);
}

}  // namespace folk::tools
