#pragma once
// Payoffs as whole numbers, so that sums of them are exact and ties are ties.

#include <folk/games/payoffs.h>

#include <array>

namespace folk {

/// Payoffs times their least common denominator.
struct WholePayoffs {
  std::array<double, 4> by_outcome{};  ///< CC, CD, DC, DD (own move first); whole numbers
  double scale = 1;                    ///< divide by it to get back to the unit of the game
  double largest = 1;                  ///< of their absolute values, at least 1

  /// True when every sum of this many rounds (or rounds times weights) is exact in a double: it stays within 2^53.
  bool exact(double rounds) const { return rounds * largest <= 0x1p53; }
};

/// Throws UsageError when the payoffs are too large or have too many digits.
WholePayoffs whole_payoffs(const Payoffs& payoffs);

}  // namespace folk
