#pragma once
// What a strategy with a window remembers of one side: its last moves, up to a number of them.

#include <folk/games/move.h>

#include <bit>
#include <cstdint>

namespace folk {

/// The last `most` moves, the newest lowest, D = 1, under a leading 1 that tells how many there are.
template <unsigned most, class Word = std::uint64_t>
class LastMoves {
  static_assert(most < 8 * sizeof(Word));

public:
  void add(Move move) {
    const bool full = length() == most;
    std::uint64_t word = (std::uint64_t{word_} << 1U) | bit(move);
    if (full) word = (word & ((std::uint64_t{1} << most) - 1)) | (std::uint64_t{1} << most);
    word_ = static_cast<Word>(word);
  }

  unsigned length() const { return static_cast<unsigned>(std::bit_width(std::uint64_t{word_})) - 1; }
  unsigned defections() const { return static_cast<unsigned>(std::popcount(std::uint64_t{word_})) - 1; }
  unsigned cooperations() const { return length() - defections(); }
  Move last() const { return before(0); }
  /// The move `rounds` rounds before the last one, which must be among those remembered.
  Move before(unsigned rounds) const { return move_from_bit(static_cast<unsigned>(word_ >> rounds) & 1U); }
  /// As bits, the leading 1 included: comparing two is comparing the moves.
  std::uint64_t word() const { return word_; }

private:
  Word word_ = 1;
};

}  // namespace folk
