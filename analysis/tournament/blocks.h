#pragma once
// How the pairs of a round robin are cut into pieces of work. It depends on nothing but their number.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace folk {

/// From `begin` up to but not including `end`.
struct Block {
  std::size_t begin = 0;
  std::size_t end = 0;

  bool operator==(const Block&) const = default;
};

/// Rows of a triangle whose row b has b + 1 pairs: each row a block, or where that would be more than 1024 blocks as
/// many rows as have a 1024th of all pairs. In ascending order.
std::vector<Block> row_blocks(std::size_t rows);

/// Pairs that think together, `matches` of each at most: each block has 1024 matches or a few more, so that those who
/// think in one block are many.
std::vector<Block> pair_blocks(std::size_t pairs, std::uint64_t matches);

}  // namespace folk
