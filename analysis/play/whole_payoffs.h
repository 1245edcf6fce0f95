#pragma once
// Payoffs as whole numbers, so that sums of them are exact and ties are ties.

#include <folk/games/payoffs.h>
#include <folk/games/rational.h>

#include <array>
#include <vector>

namespace folk {

/// Scores that are no exact whole numbers count as equal within this share of the largest possible score.
inline constexpr double score_rounding = 1e-12;

/// Payoffs times their least common denominator.
struct WholePayoffs {
  std::array<double, 4> by_outcome{};  ///< CC, CD, DC, DD (own move first); whole numbers
  double scale = 1;                    ///< divide by it to get back to the unit of the game
  double largest = 1;                  ///< of their absolute values, at least 1
  Rational exact_scale = 1;            ///< `scale` as it is where no double is (10^23 for payoffs of 23 places)

  /// True when every sum of this many rounds (or rounds times weights) is exact in a double: it stays within 2^53.
  bool exact(double rounds) const { return rounds * largest <= 0x1p53; }
};

/// `others`: further payoffs that are to be whole numbers too once multiplied by `scale`.
/// Throws UsageError when the payoffs are too large or have too many digits.
WholePayoffs whole_payoffs(const Payoffs& payoffs, const std::vector<Rational>& others = {});

}  // namespace folk
