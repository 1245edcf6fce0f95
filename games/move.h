#pragma once
// The two moves of a prisoner's dilemma.

#include <cstdint>

namespace folk {

/// C (cooperate) is the first action of a 2x2 game, D (defect) the second.
enum class Move : std::uint8_t { C = 0, D = 1 };

constexpr Move other(Move move) { return move == Move::C ? Move::D : Move::C; }
constexpr char to_char(Move move) { return move == Move::C ? 'C' : 'D'; }
constexpr unsigned bit(Move move) { return static_cast<unsigned>(move); }
constexpr Move move_from_bit(unsigned bit) { return (bit & 1U) != 0U ? Move::D : Move::C; }

}  // namespace folk
