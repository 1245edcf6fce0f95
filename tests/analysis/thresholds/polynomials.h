#pragma once
// Polynomials of the tests, with arithmetic of their own.

#include <folk/analysis/thresholds/algebraic_number.h>

#include <algorithm>
#include <vector>

namespace folk::test {

inline Polynomial polynomial(const std::vector<int>& coefficients) {
  return Polynomial(std::vector<Integer>(coefficients.begin(), coefficients.end()));
}

inline Polynomial product(const Polynomial& a, const Polynomial& b) {
  std::vector<Integer> coefficients(a.coefficients().size() + b.coefficients().size());
  for (std::size_t i = 0; i < a.coefficients().size(); ++i)
    for (std::size_t j = 0; j < b.coefficients().size(); ++j)
      coefficients[i + j] += a.coefficients()[i] * b.coefficients()[j];
  return Polynomial(std::move(coefficients));
}

template <class... Rest>
Polynomial product(const Polynomial& a, const Polynomial& b, const Rest&... rest) {
  return product(product(a, b), rest...);
}

/// Divided by the common divisor of its coefficients, the leading one made positive.
inline Polynomial primitive(const Polynomial& p) {
  Integer divisor;
  for (const Integer& c : p.coefficients()) divisor = gcd(divisor, c);
  if (p.coefficients().back() < 0) divisor = -divisor;
  std::vector<Integer> coefficients;
  for (const Integer& c : p.coefficients()) coefficients.push_back(c / divisor);
  return Polynomial(std::move(coefficients));
}

/// The remainder of a division over the rationals.
inline std::vector<Rational> remainder(std::vector<Rational> rest, const std::vector<Rational>& by) {
  while (rest.size() >= by.size()) {
    const Rational factor = rest.back() / by.back();
    for (std::size_t i = 0; i < by.size(); ++i) rest[rest.size() - by.size() + i] -= factor * by[i];
    rest.pop_back();
    while (!rest.empty() && rest.back() == 0) rest.pop_back();
  }
  return rest;
}

inline std::vector<Rational> rationals(const Polynomial& p) {
  return {p.coefficients().begin(), p.coefficients().end()};
}

inline bool divides(const Polynomial& divisor, const Polynomial& p) {
  return remainder(rationals(p), rationals(divisor)).empty();
}

/// The sign of `p` at this number: p's roots tell where it is constant.
inline int sign_at(const AlgebraicNumber& number, const Polynomial& p) {
  if (p.is_zero()) return 0;
  AlgebraicNumber fine = number;
  for (AlgebraicNumber root : roots_of(p)) {
    if (root == number) return 0;
    while (fine.low() <= root.high() && root.low() <= fine.high()) {
      fine.refine();
      root.refine();
    }
  }
  return p.sign_at(fine.low());
}

}  // namespace folk::test
