#include <folk/analysis/tournament/blocks.h>

#include <algorithm>

namespace folk {
namespace {

constexpr std::size_t most_row_blocks = 1024;
constexpr std::uint64_t matches_of_block = 1024;

}  // namespace

std::vector<Block> row_blocks(std::size_t rows) {
  const std::size_t least =
      rows <= most_row_blocks ? 1 : (rows * (rows + 1) / 2 + most_row_blocks - 1) / most_row_blocks;
  std::vector<Block> blocks;
  for (std::size_t row = 0; row < rows;) {
    Block block{row, row};
    for (std::size_t pairs = 0; row < rows && pairs < least; ++row) pairs += row + 1;
    block.end = row;
    blocks.push_back(block);
  }
  return blocks;
}

std::vector<Block> pair_blocks(std::size_t pairs, std::uint64_t matches) {
  const auto each = static_cast<std::size_t>(
      std::max<std::uint64_t>(1, (matches_of_block + matches - 1) / std::max<std::uint64_t>(1, matches)));
  std::vector<Block> blocks;
  for (std::size_t begin = 0; begin < pairs; begin += each) blocks.push_back({begin, std::min(begin + each, pairs)});
  return blocks;
}

}  // namespace folk
