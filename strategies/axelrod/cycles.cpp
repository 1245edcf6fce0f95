#include <folk/strategies/axelrod/cycles.h>

#include <algorithm>

namespace folk {

std::size_t cycle_length(const Moves& moves, std::size_t from, std::size_t shortest) {
  if (moves.size() <= from) return 0;
  const std::size_t longest = std::min<std::size_t>((moves.size() - from) / 2, 12);
  for (std::size_t length = shortest; length <= longest; ++length) {
    std::size_t round = from + length;
    while (round < moves.size() && moves[round] == moves[round - length]) ++round;
    if (round == moves.size()) return length;
  }
  return 0;
}

}  // namespace folk
