#pragma once
// Whether moves repeat.

#include <folk/strategies/axelrod/record.h>

#include <cstddef>

namespace folk {

/// The shortest length, from `shortest` to 12 and twice in what is looked at, with which the moves from round `from`
/// (counted from 0) on repeat; 0 when there is none.
std::size_t cycle_length(const Moves& moves, std::size_t from, std::size_t shortest);

}  // namespace folk
