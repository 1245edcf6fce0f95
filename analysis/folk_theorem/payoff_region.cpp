#include <folk/analysis/folk_theorem/payoff_region.h>
#include <folk/games/error.h>

#include <fmt/format.h>

namespace folk {
namespace {

Polygon<Rational> at_least(const Polygon<Rational>& polygon, const Point<Rational>& least) {
  return clipped(clipped(polygon, 0, least[0]), 1, least[1]);
}

}  // namespace

std::vector<Point<Rational>> payoff_pairs(const StageGame& game) {
  std::vector<Point<Rational>> pairs;
  for (std::size_t i = 0; i < game.rows(); ++i)
    for (std::size_t j = 0; j < game.columns(); ++j)
      pairs.push_back({game.payoff(Seat::first, i, j), game.payoff(Seat::second, i, j)});
  return pairs;
}

void require_small_for_region(const StageGame& game) {
  if (std::max(game.rows(), game.columns()) > most_region_actions)
    throw UsageError(fmt::format("a {}x{} game is too large for its payoff region: at most {} actions of each player",
                                 game.rows(), game.columns(), most_region_actions));
}

PayoffRegion payoff_region(const StageGame& game) {
  require_small_for_region(game);
  PayoffRegion region{convex_hull(payoff_pairs(game)), {minmax(game, Seat::first), minmax(game, Seat::second)}, {}, {}};
  region.individually_rational = at_least(region.feasible, region.mixed_minmax());
  region.pure_individually_rational = at_least(region.feasible, region.pure_minmax());
  return region;
}

}  // namespace folk
