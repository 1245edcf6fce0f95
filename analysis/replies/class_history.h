#pragma once
// Which gene of a member of a complete class its next move depends on.

#include <folk/games/move.h>
#include <folk/strategies/standard/memory_class.h>

#include <cstddef>
#include <cstdint>

namespace folk {

/// A match as a member of memory(X,Y) remembers it, whichever member it is.
class ClassHistory {
public:
  explicit ClassHistory(const MemoryClass& members)
      : own_memory_(members.own_memory()),
        their_memory_(members.their_memory()),
        openings_(members.openings()) {}

  /// The gene of the coming move: an opening, then an entry of the table.
  std::size_t gene() const {
    if (rounds_ < openings_) return rounds_;
    const auto last = [](std::uint32_t moves, unsigned memory) { return moves & ((1U << memory) - 1); };
    return openings_ + (last(own_, own_memory_) << their_memory_ | last(theirs_, their_memory_));
  }

  /// What was really played; `own` is the member's move.
  void observe(Move own, Move theirs) {
    own_ = own_ << 1U | static_cast<std::uint32_t>(bit(own));
    theirs_ = theirs_ << 1U | static_cast<std::uint32_t>(bit(theirs));
    if (rounds_ < openings_) ++rounds_;
  }

private:
  unsigned own_memory_;
  unsigned their_memory_;
  unsigned openings_;
  std::uint32_t rounds_ = 0;  // past ones, as far as openings_
  std::uint32_t own_ = 0;     // last moves, the last one lowest, D = 1
  std::uint32_t theirs_ = 0;
};

}  // namespace folk
