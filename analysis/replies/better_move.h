#pragma once
// Of two values that were summed up in floating point, the better; what rounding tells apart is as good.

#include <folk/games/move.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace folk {

/// What sums of products in double precision are rounded to, generously.
inline constexpr double value_rounding = 1e-9;

/// By the values of C and of D; C where neither is better by more than `rounding` of the larger value.
inline Move better_move(const std::array<double, 2>& values, double rounding = value_rounding) {
  const auto [c, d] = values;
  return d > c + rounding * std::max(std::abs(c), std::abs(d)) ? Move::D : Move::C;
}

}  // namespace folk
