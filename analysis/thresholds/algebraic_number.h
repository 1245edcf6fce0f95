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
  /// is recognised as one, always: of all fractions whose denominator divides p's leading coefficient at most one lies
  /// in an interval short enough, and it is tried. Throws std::logic_error when p's signs at the ends are not opposite.
  AlgebraicNumber(std::shared_ptr<const Polynomial> p, const Rational& low, const Rational& high);

  bool is_rational() const { return polynomial_ == nullptr; }

  /// Rational bounds: the number itself twice, or the open isolating interval.
  const Rational& low() const { return low_; }
  const Rational& high() const { return high_; }

  /// What an irrational number is a root of; may have other factors than the minimal polynomial.
  const std::shared_ptr<const Polynomial>& polynomial() const { return polynomial_; }

  /// Halves the isolating interval of an irrational number.
  void refine();

  /// The nearest double.
  double nearest() const;

  /// The sign of `p` at this number: -1, 0 or 1.
  int sign_of(const Polynomial& p) const;

private:
  std::shared_ptr<const Polynomial> polynomial_;
  Rational low_;
  Rational high_;
  int sign_at_low_ = 0;  // of the polynomial
};

/// Exact: by refinement, equality of irrational numbers by the common factor of their polynomials.
std::strong_ordering operator<=>(const AlgebraicNumber& a, const AlgebraicNumber& b);
inline bool operator==(const AlgebraicNumber& a, const AlgebraicNumber& b) { return (a <=> b) == 0; }

/// A rational strictly between two numbers a < b, of few binary places where there is room. The place is a little below
/// the middle and never a multiple of 1/32 when a coarse one fits, because the ends of such sets often are.
Rational rational_between(AlgebraicNumber a, AlgebraicNumber b);

}  // namespace folk
