#pragma once
// What both players do in one round, as one of them sees it.

#include <folk/games/move.h>

#include <array>
#include <cstddef>

namespace folk {

/// The outcome of one round: both moves, one's own first. A history is a sequence of them.
struct Outcome {
  Move own = Move::C;
  Move theirs = Move::C;

  /// Its place in whatever is kept by outcome: CC = 0, CD = 1, DC = 2, DD = 3.
  constexpr std::size_t index() const { return 2U * bit(own) + bit(theirs); }

  /// The same round as the other player sees it.
  constexpr Outcome exchanged() const { return {theirs, own}; }

  /// What would have come about had one deviated: the other own move, the same of theirs.
  constexpr Outcome deviated() const { return {other(own), theirs}; }

  bool operator==(const Outcome&) const = default;
};

/// By index.
inline constexpr std::array<Outcome, 4> all_outcomes{
    {{Move::C, Move::C}, {Move::C, Move::D}, {Move::D, Move::C}, {Move::D, Move::D}}};

}  // namespace folk
