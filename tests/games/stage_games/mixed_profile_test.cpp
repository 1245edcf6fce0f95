#include <folk/games/stage_games/mixed_profile.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "games/arbitrary.h"
#include "games/expect_error.h"

namespace folk {
namespace {

using test::expect_error;

/// Rows a, b against columns x, y, z.
StageGame two_by_three() {
  return StageGame("T", {"P", "Q"}, {{{"a", "b"}, {"x", "y", "z"}}},
                   {{1, 10}, {2, 20}, {3, 30}, {4, 40}, {5, 50}, {6, 0}});
}

TEST(MixedProfile, PaysTheAverage) {
  const StageGame game = two_by_three();
  const MixedProfile profile{{{1, 3}, {2, 3}}, {{1, 2}, 0, {1, 2}}};
  EXPECT_EQ(action_payoffs(game, Seat::first, profile.column), (std::vector<Rational>{2, 5}));
  EXPECT_EQ(action_payoffs(game, Seat::second, profile.row), (std::vector<Rational>{30, 40, 10}));
  EXPECT_EQ(expected_payoff(game, Seat::first, profile), 4);
  EXPECT_EQ(expected_payoff(game, Seat::second, profile), 20);
  EXPECT_EQ(largest_gain(game, Seat::first, profile), 1);
  EXPECT_EQ(largest_gain(game, Seat::second, profile), 20);
  EXPECT_FALSE(is_equilibrium(game, profile));
  EXPECT_TRUE(is_equilibrium(game, {pure_action(2, 1), pure_action(3, 1)}));
}

TEST(MixedProfile, PureMinmaxBySeat) {
  EXPECT_EQ(pure_minmax(two_by_three(), Seat::first), 4);    // held to b's payoff at x
  EXPECT_EQ(pure_minmax(two_by_three(), Seat::second), 30);  // at a, against z
}

TEST(MixedProfile, RefusesWhatIsNoMixedAction) {
  const StageGame game = two_by_three();
  const auto payoff = [&](MixedAction row, MixedAction column) {
    return [&game, profile = MixedProfile{row, column}] { expected_payoff(game, Seat::first, profile); };
  };
  expect_error<UsageError>(payoff({1}, {1, 0, 0}), "1 probabilities for 2 actions");
  expect_error<UsageError>(payoff({1, 0}, {1, 0}), "2 probabilities for 3 actions");
  expect_error<UsageError>(payoff({2, -1}, {1, 0, 0}), "has the probability -1");
  expect_error<UsageError>(payoff({1, 0}, {{1, 2}, {1, 3}, 0}), "add up to 5/6: make it 1");
  expect_error<UsageError>([] { pure_action(2, 2); }, "there is no action 2");
}

RC_GTEST_PROP(MixedProfile, AnEquilibriumIsAProfileWithoutPureDeviations, (const StageGame& game)) {
  const auto i = *rc::gen::inRange<std::size_t>(0, game.rows());
  const auto j = *rc::gen::inRange<std::size_t>(0, game.columns());
  bool stays = true;
  for (std::size_t k = 0; k < game.rows(); ++k)
    stays = stays && game.payoff(Seat::first, k, j) <= game.payoff(Seat::first, i, j);
  for (std::size_t k = 0; k < game.columns(); ++k)
    stays = stays && game.payoff(Seat::second, i, k) <= game.payoff(Seat::second, i, j);
  RC_ASSERT(is_equilibrium(game, {pure_action(game.rows(), i), pure_action(game.columns(), j)}) == stays);
}

}  // namespace
}  // namespace folk
