#include <folk/strategies/axelrod/last_moves.h>

#include <gtest/gtest.h>

namespace folk {
namespace {

TEST(LastMoves, ForgetTheOldestOnly) {
  LastMoves<3, std::uint8_t> moves;
  EXPECT_EQ(moves.length(), 0U);
  for (const Move move : {Move::D, Move::C, Move::C}) moves.add(move);
  EXPECT_EQ(moves.length(), 3U);
  EXPECT_EQ(moves.defections(), 1U);
  EXPECT_EQ(moves.before(2), Move::D);
  moves.add(Move::D);
  EXPECT_EQ(moves.length(), 3U);
  EXPECT_EQ(moves.defections(), 1U);
  EXPECT_EQ(moves.cooperations(), 2U);
  EXPECT_EQ(moves.last(), Move::D);
  EXPECT_EQ(moves.word(), 0b1001U);
}

}  // namespace
}  // namespace folk
