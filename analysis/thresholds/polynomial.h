#pragma once
// Polynomials in the discount factor d with integer coefficients of any size: exact, by FLINT.

#include <folk/games/rational.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace folk {

/// c0 + c1 d + c2 d^2 + ...
class Polynomial {
public:
  Polynomial() = default;  ///< 0
  /// Coefficients from the constant on; zeros at the end are dropped.
  explicit Polynomial(std::vector<Integer> coefficients)
      : coefficients_(std::move(coefficients)) {
    while (!coefficients_.empty() && coefficients_.back().is_zero()) coefficients_.pop_back();
  }

  bool is_zero() const { return coefficients_.empty(); }
  /// 0 for constants, and for the polynomial 0 too.
  std::size_t degree() const { return is_zero() ? 0 : coefficients_.size() - 1; }
  /// From the constant on; empty for 0, else the last is not 0.
  const std::vector<Integer>& coefficients() const { return coefficients_; }

  bool operator==(const Polynomial&) const = default;

  /// -1, 0 or 1.
  int sign_at(const Rational& d) const {
    Integer value;
    Integer power = 1;
    for (auto c = coefficients_.rbegin(); c != coefficients_.rend(); ++c, power *= denominator(d))
      value = value * numerator(d) + *c * power;
    return value.sign();
  }
  /// Whether the signs at these two places are opposite.
  bool crosses(const Rational& low, const Rational& high) const { return sign_at(low) * sign_at(high) < 0; }

private:
  std::vector<Integer> coefficients_;
};

/// False in a build without FLINT, in which all that follows here throws EnvironmentError.
bool flint_available();

/// "3 d^2 + d - 1".
std::string to_text(const Polynomial& p);

/// Over the rationals; primitive with a positive leading coefficient (0 of two zeros).
Polynomial greatest_common_divisor(const Polynomial& a, const Polynomial& b);

/// The irreducible factor over the rationals that crosses between `low` and `high`, which one must do; primitive with a
/// positive leading coefficient.
Polynomial irreducible_factor(const Polynomial& p, const Rational& low, const Rational& high);

/// The distinct roots of a polynomial in (0, 1).
struct RootIsolation {
  Polynomial polynomial;  ///< the given one without factors d and 1 - d, repeated ones and content
  /// Ascending: {r, r}, or the ends of an open interval where the polynomial crosses at its only root, disjoint ones.
  std::vector<std::pair<Rational, Rational>> roots;
};

/// By bisection and Descartes' rule of signs (Collins & Akritas 1976). `p` is not 0.
RootIsolation isolate_roots(const Polynomial& p);

}  // namespace folk
