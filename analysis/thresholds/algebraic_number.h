#pragma once
// Exact real algebraic numbers between 0 and 1: the ends of sets of discount factors.

#include <folk/analysis/thresholds/polynomial.h>

#include <compare>
#include <memory>

namespace folk {

/// A rational, or an irrational root of an integer polynomial, told from its other roots by an interval.
class AlgebraicNumber {
public:
  AlgebraicNumber(const Rational& value);  // NOLINT(google-explicit-constructor): every rational is algebraic

  /// The only root of `p` in the open interval (low, high): simple, and p does not vanish at the ends. A rational root
  /// is recognised as one, always. Throws std::logic_error when p's signs at the ends are not opposite.
  AlgebraicNumber(std::shared_ptr<const Polynomial> p, const Rational& low, const Rational& high);

  bool is_rational() const { return polynomial_ == nullptr; }

  /// Rational bounds: the number itself twice, or the open isolating interval.
  const Rational& low() const { return low_; }
  const Rational& high() const { return high_; }

  /// Of an irrational number; primitive with a positive leading coefficient.
  Polynomial minimal_polynomial() const { return irreducible_factor(*polynomial_, low_, high_); }

  /// Halves the isolating interval of an irrational number.
  void refine();

  /// The nearest double.
  double nearest() const;

  /// Exact: by refinement, equality of irrational numbers by the common factor of their polynomials.
  friend std::strong_ordering operator<=>(const AlgebraicNumber& a, const AlgebraicNumber& b);
  friend bool operator==(const AlgebraicNumber& a, const AlgebraicNumber& b) { return (a <=> b) == 0; }

private:
  std::shared_ptr<const Polynomial> polynomial_;
  Rational low_;
  Rational high_;
};

/// The distinct roots of `p` (not 0) in (0, 1), ascending, their intervals disjoint.
std::vector<AlgebraicNumber> roots_of(const Polynomial& p);

}  // namespace folk
