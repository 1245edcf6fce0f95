#pragma once
// The two seats at a table: who is the first player and who the second.

#include <array>
#include <cstddef>

namespace folk {

/// In a stage game the first player picks the row and the second the column.
enum class Seat : std::size_t { first = 0, second = 1 };

inline constexpr std::array both_seats{Seat::first, Seat::second};

constexpr Seat other(Seat seat) { return seat == Seat::first ? Seat::second : Seat::first; }

/// The place of a seat in whatever is kept for both: 0 and 1.
constexpr std::size_t index(Seat seat) { return static_cast<std::size_t>(seat); }

}  // namespace folk
