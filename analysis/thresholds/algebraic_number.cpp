#include <folk/analysis/thresholds/algebraic_number.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <utility>

namespace folk {
namespace {

/// The fraction of the smallest denominator in [low, high], 0 <= low < high (Stern-Brocot, by continued fractions).
Rational simplest_between(const Rational& low, const Rational& high) {
  const Integer whole = numerator(low) / denominator(low);
  if (Rational(whole) == low) return low;
  if (Rational(whole + 1) <= high) return Rational(whole + 1);
  return Rational(whole) + 1 / simplest_between(1 / (high - whole), 1 / (low - whole));
}

/// True when two irrational numbers, whose intervals overlap, are one.
bool equal(const AlgebraicNumber& a, const AlgebraicNumber& b) {
  const Polynomial common =
      a.polynomial() == b.polynomial() ? *a.polynomial() : greatest_common_divisor(*a.polynomial(), *b.polynomial());
  if (common.degree() == 0) return false;
  // A root of the common factor in both intervals is the only and simple root of both there.
  const Rational low = std::max(a.low(), b.low());
  const Rational high = std::min(a.high(), b.high());
  return low < high && common.sign_at(low) * common.sign_at(high) < 0;
}

}  // namespace

AlgebraicNumber::AlgebraicNumber(const Rational& value)
    : low_(value),
      high_(value) {}

AlgebraicNumber::AlgebraicNumber(std::shared_ptr<const Polynomial> p, const Rational& low, const Rational& high)
    : polynomial_(std::move(p)),
      low_(low),
      high_(high),
      sign_at_low_(polynomial_->sign_at(low)) {
  if (sign_at_low_ * polynomial_->sign_at(high) >= 0)
    throw std::logic_error("an algebraic number needs an interval at whose ends its polynomial has opposite signs");
  const Integer leading = abs(polynomial_->leading());
  const Rational apart(1, leading * leading);  // two fractions of such denominators are at least this far apart
  while (!is_rational() && high_ - low_ >= apart) refine();
  if (is_rational()) return;
  const Rational candidate = simplest_between(low_, high_);
  if (polynomial_->sign_at(candidate) == 0) *this = AlgebraicNumber(candidate);
}

void AlgebraicNumber::refine() {
  if (is_rational()) return;
  const Rational middle = (low_ + high_) / 2;
  const int sign = polynomial_->sign_at(middle);
  if (sign == 0)
    *this = AlgebraicNumber(middle);
  else if (sign == sign_at_low_)
    low_ = middle;
  else
    high_ = middle;
}

double AlgebraicNumber::nearest() const {
  AlgebraicNumber fine = *this;
  while (to_double(fine.low()) != to_double(fine.high())) fine.refine();
  return to_double(fine.low());
}

int AlgebraicNumber::sign_of(const Polynomial& p) const {
  if (is_rational() || p.is_zero()) return p.sign_at(low_);
  const Polynomial common = greatest_common_divisor(p, *polynomial_);
  if (common.degree() > 0 && common.sign_at(low_) * common.sign_at(high_) < 0) return 0;
  // p has no root here, so none in an interval that is short enough: its derivative's size tells when.
  AlgebraicNumber fine = *this;
  Rational slope = 0;
  for (std::size_t i = 1; i < p.coefficients().size(); ++i) slope += abs(p.coefficients()[i]) * i;
  const auto value = [&](const Rational& d) {
    Rational sum = 0;
    for (std::size_t i = p.coefficients().size(); i-- > 0;) sum = sum * d + p.coefficients()[i];
    return sum;
  };
  for (;; fine.refine()) {
    const Rational at_low = value(fine.low());
    if (abs(at_low) > slope * (fine.high() - fine.low())) return at_low.sign();
  }
}

std::strong_ordering operator<=>(const AlgebraicNumber& a, const AlgebraicNumber& b) {
  AlgebraicNumber x = a;
  AlgebraicNumber y = b;
  for (bool asked = false;;) {
    if (x.is_rational() && y.is_rational())
      return x.low() < y.low()   ? std::strong_ordering::less
             : x.low() > y.low() ? std::strong_ordering::greater
                                 : std::strong_ordering::equal;
    if (x.high() <= y.low()) return std::strong_ordering::less;
    if (y.high() <= x.low()) return std::strong_ordering::greater;
    if (!asked && !x.is_rational() && !y.is_rational()) {
      if (equal(x, y)) return std::strong_ordering::equal;
      asked = true;
    }
    x.refine();
    y.refine();
  }
}

Rational rational_between(AlgebraicNumber a, AlgebraicNumber b) {
  while (a.high() >= b.low()) {
    a.refine();
    b.refine();
  }
  const double near = 0.55 * to_double(a.high()) + 0.45 * to_double(b.low());
  for (int places = 6; places <= 40; ++places) {
    const auto odd = static_cast<std::int64_t>(std::ldexp(near, places)) | 1;
    const Rational candidate(odd, std::int64_t{1} << places);
    if (a.high() < candidate && candidate < b.low()) return candidate;
  }
  return (a.high() + b.low()) / 2;
}

}  // namespace folk
