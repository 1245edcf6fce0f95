#pragma once
// The two moves of a prisoner's dilemma, and the four outcomes of one round.

#include <cstddef>
#include <cstdint>

namespace folk {

/// C (cooperate) is the first action of a 2x2 game, D (defect) the second.
enum class Move : std::uint8_t { C = 0, D = 1 };

constexpr Move other(Move move) { return move == Move::C ? Move::D : Move::C; }
constexpr char to_char(Move move) { return move == Move::C ? 'C' : 'D'; }
constexpr unsigned bit(Move move) { return static_cast<unsigned>(move); }
constexpr Move move_from_bit(unsigned bit) { return (bit & 1U) != 0U ? Move::D : Move::C; }

/// Index of a round's outcome, own move first: CC = 0, CD = 1, DC = 2, DD = 3.
constexpr std::size_t outcome(Move own, Move theirs) { return 2U * bit(own) + bit(theirs); }

}  // namespace folk
