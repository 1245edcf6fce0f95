#pragma once
// The probability with which a move flips.

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

}  // namespace folk
