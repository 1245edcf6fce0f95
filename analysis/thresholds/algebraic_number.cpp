#include <folk/analysis/thresholds/algebraic_number.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace folk {

AlgebraicNumber::AlgebraicNumber(const Rational& value)
    : low_(value),
      high_(value) {}

AlgebraicNumber::AlgebraicNumber(std::shared_ptr<const Polynomial> p, const Rational& low, const Rational& high)
    : polynomial_(std::move(p)),
      low_(low),
      high_(high) {
  if (!polynomial_->crosses(low, high))
    throw std::logic_error("an algebraic number needs an interval at whose ends its polynomial has opposite signs");
  // A rational root's denominator divides the leading coefficient: two such fractions are at least this far apart.
  const Rational apart(1, pow(polynomial_->coefficients().back(), 2));
  while (!is_rational() && high_ - low_ >= apart) refine();
  if (is_rational()) return;
  const Rational candidate = simplest_between(low_, high_);
  if (polynomial_->sign_at(candidate) == 0) *this = candidate;
}

void AlgebraicNumber::refine() {
  if (is_rational()) return;
  const Rational middle = (low_ + high_) / 2;
  const int sign = polynomial_->sign_at(middle);
  if (sign == 0)
    *this = middle;
  else
    (sign == polynomial_->sign_at(low_) ? low_ : high_) = middle;
}

double AlgebraicNumber::nearest() const {
  AlgebraicNumber fine = *this;
  while (to_double(fine.low()) != to_double(fine.high())) fine.refine();
  return to_double(fine.low());
}

std::strong_ordering operator<=>(const AlgebraicNumber& a, const AlgebraicNumber& b) {
  const Rational& low = std::max(a.low(), b.low());
  const Rational& high = std::min(a.high(), b.high());
  // A root of the common factor in both intervals is the only and simple root of both there.
  if (!a.is_rational() && !b.is_rational() && low < high &&
      greatest_common_divisor(*a.polynomial_, *b.polynomial_).crosses(low, high))
    return std::strong_ordering::equal;
  AlgebraicNumber x = a;
  AlgebraicNumber y = b;
  for (;; x.refine(), y.refine()) {
    if (x.is_rational() && y.is_rational()) return x.low() <=> y.low();
    if (x.high() <= y.low()) return std::strong_ordering::less;
    if (y.high() <= x.low()) return std::strong_ordering::greater;
  }
}

std::vector<AlgebraicNumber> roots_of(const Polynomial& p) {
  RootIsolation found = isolate_roots(p);
  const auto polynomial = std::make_shared<const Polynomial>(std::move(found.polynomial));
  std::vector<AlgebraicNumber> roots;
  for (const auto& [low, high] : found.roots)
    roots.push_back(low == high ? AlgebraicNumber(low) : AlgebraicNumber(polynomial, low, high));
  return roots;
}

}  // namespace folk
