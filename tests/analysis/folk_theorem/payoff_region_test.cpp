#include <folk/analysis/folk_theorem/payoff_region.h>
#include <folk/games/stage_games/reference_games.h>
#include <gtest/gtest.h>

#include "games/expect_error.h"

namespace folk {
namespace {

using test::expect_error;
using Shape = Polygon<Rational>;

TEST(PayoffRegion, OfTheDilemma) {
  const Rational most(13, 3);
  const PayoffRegion region = payoff_region(reference_game("prisoners_dilemma").game);
  EXPECT_EQ(region.feasible, (Shape{{0, 5}, {1, 1}, {5, 0}, {3, 3}}));
  EXPECT_EQ(region.mixed_minmax(), (Point<Rational>{1, 1}));
  EXPECT_EQ(region.individually_rational, (Shape{{1, 1}, {most, 1}, {3, 3}, {1, most}}));
  EXPECT_EQ(region.pure_individually_rational, region.individually_rational);
}

// Mixing holds each seat to 1/5, below the 1 of pure actions, so that more is individually rational.
TEST(PayoffRegion, OfTheBattleOfTheSexes) {
  const Rational low(1, 5);
  const Rational high(4, 5);
  const PayoffRegion region = payoff_region(reference_game("battle_of_the_sexes").game);
  EXPECT_EQ(region.feasible, (Shape{{-1, -1}, {2, 1}, {1, 2}}));
  EXPECT_EQ(region.individually_rational, (Shape{{low, low}, {high, low}, {2, 1}, {1, 2}, {low, high}}));
  EXPECT_EQ(region.pure_individually_rational, (Shape{{1, 1}, {2, 1}, {1, 2}}));
}

TEST(PayoffRegion, OfAZeroSumGame) {
  const PayoffRegion region = payoff_region(reference_game("matching_pennies").game);
  EXPECT_EQ(region.feasible, (Shape{{-1, 1}, {1, -1}}));
  EXPECT_EQ(region.individually_rational, (Shape{{0, 0}}));
  EXPECT_TRUE(region.pure_individually_rational.empty());
}

TEST(PayoffRegion, HoldsEveryEquilibrium) {
  for (const ReferenceGame& entry : reference_games()) {
    const PayoffRegion region = payoff_region(entry.game);
    for (const MixedProfile& profile : entry.equilibria) {
      const Point<Rational> point{expected_payoff(entry.game, Seat::first, profile),
                                  expected_payoff(entry.game, Seat::second, profile)};
      Shape more = region.individually_rational;
      more.push_back(point);
      EXPECT_EQ(convex_hull(more), region.individually_rational) << entry.name;
    }
  }
}

TEST(PayoffRegion, RefusesLargeGames) {
  std::vector<std::string> names;
  for (int i = 0; i < 41; ++i) names.push_back(std::to_string(i));
  const StageGame game("", {"", ""}, {names, names}, std::vector<std::array<Rational, 2>>(41 * 41));
  expect_error<UsageError>([&] { payoff_region(game); }, "a 41x41 game is too large for its payoff region");
}

}  // namespace
}  // namespace folk
