#pragma once
// Polynomials in the discount factor d with integer coefficients of any size, exact throughout.

#include <folk/games/rational.h>

#include <cstddef>
#include <string>
#include <vector>

namespace folk {

/// c0 + c1 d + c2 d^2 + ...
class Polynomial {
public:
  /// The polynomial 0.
  Polynomial() = default;

  /// Coefficients from the constant on; zeros at the end are dropped.
  explicit Polynomial(std::vector<Integer> coefficients);

  bool is_zero() const { return coefficients_.empty(); }
  /// 0 for constants, and for the polynomial 0 too.
  std::size_t degree() const { return coefficients_.empty() ? 0 : coefficients_.size() - 1; }
  /// From the constant on; empty for 0, else the last is not 0.
  const std::vector<Integer>& coefficients() const { return coefficients_; }
  const Integer& leading() const { return coefficients_.back(); }

  Polynomial operator-() const;
  Polynomial operator+(const Polynomial& other) const;
  Polynomial operator-(const Polynomial& other) const;
  Polynomial operator*(const Polynomial& other) const;
  bool operator==(const Polynomial&) const = default;

  /// The product with d^k.
  Polynomial times_power(std::size_t k) const;

  /// The product with 1 - d^k, k >= 1.
  Polynomial times_one_minus_power(std::size_t k) const;

  Polynomial derivative() const;

  /// Divided by the greatest common divisor of the coefficients, which is taken positive: signs stay.
  Polynomial primitive_part() const;

  /// Divided by every factor d and 1 - d and by the content: on (0, 1) the same signs and roots.
  Polynomial reduced_on_unit_interval() const;

  /// -1, 0 or 1.
  int sign_at(const Rational& d) const;

private:
  void trim();

  std::vector<Integer> coefficients_;
};

/// The quotient, `divisor` being known to divide `dividend` over the integers and not to be 0.
Polynomial exact_quotient(const Polynomial& dividend, const Polynomial& divisor);

/// A greatest common divisor over the rationals as a primitive polynomial with a positive leading coefficient (0 of two
/// zeros). From its image modulo a prime where its coefficients are small, with an exact check; else by a primitive
/// remainder sequence.
Polynomial greatest_common_divisor(const Polynomial& a, const Polynomial& b);

/// The product of the distinct irreducible factors, primitive: p / gcd(p, p'). `p` is not 0.
Polynomial squarefree_part(const Polynomial& p);

/// "3 d^2 + d - 1".
std::string to_text(const Polynomial& p);

}  // namespace folk
