#pragma once
// Settings of learners that must lie in a range.

#include <folk/games/error.h>

#include <fmt/format.h>

#include <cstdint>

namespace folk::mpe {

/// Throws UsageError "NAME VALUE: expected a number from LOW to HIGH" unless it is one.
inline void require_number(const char* name, double value, double low, double high) {
  if (!(value >= low && value <= high))
    throw UsageError(fmt::format("{} {}: expected a number from {} to {}", name, value, low, high));
}

/// The same of a whole number.
inline void require_count(const char* name, std::uint64_t value, std::uint64_t low, std::uint64_t high) {
  if (value < low || value > high)
    throw UsageError(fmt::format("{} {}: expected a whole number from {} to {}", name, value, low, high));
}

}  // namespace folk::mpe
