#pragma once
// The probability with which a move flips.

#include <array>

namespace folk {

/// A number in [0, 1] that cannot be another one, and stands wherever a number does.
class Noise {
public:
  /// No move flips.
  constexpr Noise() = default;

  /// Throws UsageError outside [0, 1] and for NaN.
  Noise(double probability);

  constexpr double probability() const { return probability_; }
  constexpr operator double() const { return probability_; }

private:
  double probability_ = 0;
};

/// P(C) and P(D) of the move that is really played when C is meant with this probability: each is a sum, so that a
/// small one keeps all its digits.
constexpr std::array<double, 2> really_played(double cooperation, Noise noise) {
  return {cooperation * (1 - noise) + (1 - cooperation) * noise, (1 - cooperation) * (1 - noise) + cooperation * noise};
}

}  // namespace folk
