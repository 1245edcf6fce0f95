#include <folk/analysis/replies/better_move.h>

#include <gtest/gtest.h>

namespace folk {
namespace {

TEST(BetterMove, IsCWhereRoundingAloneTellsThemApart) {
  EXPECT_EQ(better_move({3, 3 + 1e-12}), Move::C);
  EXPECT_EQ(better_move({3, 3 + 1e-6}), Move::D);
  EXPECT_EQ(better_move({-3e6, -3e6 + 1e-6}), Move::C);  // a share of what is at stake
  EXPECT_EQ(better_move({3, 3 + 1e-6}, 1e-5), Move::C);
  EXPECT_EQ(better_move({1, 0}), Move::C);
  EXPECT_EQ(better_move({0, 1}), Move::D);
}

}  // namespace
}  // namespace folk
