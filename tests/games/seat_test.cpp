#include <folk/games/seat.h>
#include <folk/games/stage_game.h>

#include <gtest/gtest.h>

namespace folk {
namespace {

TEST(Seat, TheOtherOfTheOtherIsOneself) {
  for (const Seat seat : both_seats) {
    EXPECT_NE(other(seat), seat);
    EXPECT_EQ(other(other(seat)), seat);
  }
}

TEST(Seat, BothInOrderAndByIndex) {
  EXPECT_EQ(both_seats[0], Seat::first);
  EXPECT_EQ(both_seats[1], Seat::second);
  for (std::size_t i = 0; i < both_seats.size(); ++i) EXPECT_EQ(index(both_seats[i]), i);
}

TEST(Seat, TheFirstPicksTheRow) {
  const StageGame game("", {"", ""}, {{{"a", "b"}, {"x"}}}, {{1, 2}, {3, 4}});
  EXPECT_EQ(game.actions(Seat::first).size(), game.rows());
  EXPECT_EQ(game.actions(Seat::second).size(), game.columns());
  EXPECT_EQ(game.payoff(Seat::first, 1, 0), 3);
  EXPECT_EQ(game.payoff(Seat::second, 1, 0), 4);
}

}  // namespace
}  // namespace folk
