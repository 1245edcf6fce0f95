#include <folk/strategies/axelrod/cycles.h>

#include <gtest/gtest.h>

#include <string_view>

namespace folk {
namespace {

Moves played(std::string_view text) {
  Moves moves;
  for (const char c : text) moves.add(c == 'C' ? Move::C : Move::D);
  return moves;
}

TEST(CycleLength, IsTheShortestThatIsSeenTwice) {
  EXPECT_EQ(cycle_length(played("CDCD"), 0, 1), 2U);
  EXPECT_EQ(cycle_length(played("CCCC"), 0, 1), 1U);
  EXPECT_EQ(cycle_length(played("CDCDCDC"), 0, 3), 0U);  // of three to begin with; four are not seen twice
  EXPECT_EQ(cycle_length(played("CDCDCDCD"), 0, 3), 4U);
  EXPECT_EQ(cycle_length(played("CCDCC"), 0, 1), 0U);  // three are not seen twice
  EXPECT_EQ(cycle_length(played("CCDCCDC"), 0, 1), 3U);
}

TEST(CycleLength, LooksFromARoundOn) {
  EXPECT_EQ(cycle_length(played("DDDCDCD"), 3, 1), 2U);
  EXPECT_EQ(cycle_length(played("CD"), 5, 1), 0U);
}

}  // namespace
}  // namespace folk
