#include <folk/games/stage_game.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "games/arbitrary.h"
#include "games/expect_error.h"

namespace folk {
namespace {

using test::expect_error;

StageGame two_by_three() {
  return StageGame("T", {"P", "Q"}, {{{"a", "b"}, {"x", "y", "z"}}},
                   {{1, 10}, {2, 20}, {3, 30}, {4, 40}, {5, 50}, {6, 60}});
}

TEST(StageGame, FindsPayoffsByRowAndColumn) {
  const StageGame game = two_by_three();
  EXPECT_EQ(game.rows(), 2U);
  EXPECT_EQ(game.columns(), 3U);
  EXPECT_EQ(game.actions(Seat::second), (std::vector<std::string>{"x", "y", "z"}));
  EXPECT_EQ(game.payoff(Seat::first, 0, 2), 3);
  EXPECT_EQ(game.payoff(Seat::second, 1, 0), 40);
}

TEST(StageGame, RefusesWhatIsNoGame) {
  const auto make = [](std::vector<std::string> rows, std::vector<std::string> columns, std::size_t pairs) {
    return [=] { StageGame("T", {"P", "Q"}, {rows, columns}, std::vector<std::array<Rational, 2>>(pairs)); };
  };
  expect_error<UsageError>(make({}, {"x"}, 0), "at least one action");
  expect_error<UsageError>(make({"a"}, {}, 0), "at least one action");
  expect_error<UsageError>(make({"a", ""}, {"x"}, 2), "empty name");
  expect_error<UsageError>(make({"a"}, {"x\n", "x\n"}, 2), "action 'x?' of a stage game is given twice");
  expect_error<UsageError>(make({"a", "b"}, {"x", "y"}, 3), "a 2x2 game needs 4 payoff pairs, not 3");
}

TEST(StageGame, KnowsSymmetry) {
  EXPECT_FALSE(two_by_three().is_symmetric());
  EXPECT_TRUE(StageGame("", {}, {{{"C", "D"}, {"C", "D"}}}, {{3, 3}, {0, 5}, {5, 0}, {1, 1}}).is_symmetric());
  EXPECT_FALSE(StageGame("", {}, {{{"C", "D"}, {"C", "D"}}}, {{3, 3}, {0, 5}, {4, 0}, {1, 1}}).is_symmetric());
  EXPECT_FALSE(StageGame("", {}, {{{"C", "D"}, {"C", "D"}}}, {{3, 2}, {0, 5}, {5, 0}, {1, 1}}).is_symmetric());
}

RC_GTEST_PROP(StageGame, SameGameIgnoresTitlesAndComments, (const StageGame& game)) {
  std::vector<std::array<Rational, 2>> payoffs;
  for (std::size_t i = 0; i < game.rows(); ++i)
    for (std::size_t j = 0; j < game.columns(); ++j)
      payoffs.push_back({game.payoff(Seat::first, i, j), game.payoff(Seat::second, i, j)});
  const std::array<std::vector<std::string>, 2> actions{game.actions(Seat::first), game.actions(Seat::second)};
  RC_ASSERT(game.same_game(StageGame("other", {"other", "names"}, actions, payoffs, "and comment")));
  payoffs.back()[1] += 1;
  RC_ASSERT(!game.same_game(StageGame(game.title(), game.players(), actions, payoffs)));
}

}  // namespace
}  // namespace folk
