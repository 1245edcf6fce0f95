#include <folk/analysis/tournament/blocks.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace folk {
namespace {

/// Blocks follow upon each other, without a gap, to `end`.
void expect_whole(const std::vector<Block>& blocks, std::size_t end) {
  std::size_t begin = 0;
  for (const Block& block : blocks) {
    EXPECT_EQ(block.begin, begin);
    EXPECT_GT(block.end, block.begin);
    begin = block.end;
  }
  EXPECT_EQ(begin, end);
}

TEST(RowBlocks, AreRowsUntilThereAreTooMany) {
  for (const std::size_t rows : {0U, 1U, 17U, 1024U}) {
    expect_whole(row_blocks(rows), rows);
    EXPECT_EQ(row_blocks(rows).size(), rows);
  }
}

TEST(RowBlocks, OfManyRowsHaveAboutAsManyPairs) {
  for (const std::size_t rows : {1025U, 2000U, 10'000U}) {
    const auto blocks = row_blocks(rows);
    expect_whole(blocks, rows);
    EXPECT_LE(blocks.size(), 1024U);
    const std::size_t even = rows * (rows + 1) / 2 / 1024;
    for (const Block& block : blocks) {
      const std::size_t pairs = (block.begin + 1 + block.end) * (block.end - block.begin) / 2;
      EXPECT_LE(pairs, even + rows + 1);
    }
  }
}

TEST(PairBlocks, HaveAThousandMatchesOrAFewMore) {
  expect_whole(pair_blocks(0, 100), 0);
  for (const std::uint64_t matches : {1U, 100U, 1000U, 5000U}) {
    const auto blocks = pair_blocks(5000, matches);
    expect_whole(blocks, 5000);
    for (const Block& block : blocks) {
      EXPECT_TRUE(block.end == 5000 || (block.end - block.begin) * matches >= 1024U);
      EXPECT_LT((block.end - block.begin - 1) * matches, 1024U);
    }
  }
}

}  // namespace
}  // namespace folk
