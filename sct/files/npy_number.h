#pragma once
// The types of the numbers in .npy files, and their C++ types.

#include <cstdint>
#include <type_traits>

namespace folk::sct {

/// The types of number that Folk reads and writes; their names in a file are <f4 <f8 <i4 <i8 |i1 |u1 |b1.
enum class NpyType { float32, float64, int32, int64, int8, uint8, boolean };

/// Calls `with(zero)` with a zero of the type's own C++ type and returns what it returns; truth values are bytes.
template <class With>
auto with_type(NpyType type, With with) {
  switch (type) {
    case NpyType::float32: return with(float{});
    case NpyType::float64: return with(double{});
    case NpyType::int32: return with(std::int32_t{});
    case NpyType::int64: return with(std::int64_t{});
    case NpyType::int8: return with(std::int8_t{});
    case NpyType::uint8:
    case NpyType::boolean: break;
  }
  return with(std::uint8_t{});
}

/// The unsigned word with the bits of a number.
template <class Number>
using WordOf = std::conditional_t<sizeof(Number) == 8, std::uint64_t,
                                  std::conditional_t<sizeof(Number) == 4, std::uint32_t, std::uint8_t>>;

}  // namespace folk::sct
