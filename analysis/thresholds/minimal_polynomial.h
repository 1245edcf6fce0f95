#pragma once
// The simplest polynomial that an algebraic number is a root of, and the number written by it.

#include <folk/analysis/thresholds/algebraic_number.h>

#include <string>

namespace folk {

/// Minimal polynomials of a higher degree are not looked for.
inline constexpr std::size_t most_minimal_degree = 10;

/// The minimal polynomial of an irrational number, primitive and with a positive leading coefficient, by lattice
/// reduction (Kannan, Lenstra & Lovasz 1988) and an exact check. Where none of degree `most_minimal_degree` or less is
/// found: the number's polynomial without repeated factors and without roots of unity.
Polynomial minimal_polynomial(const AlgebraicNumber& number);

/// "1/2", or "root of 3 d^2 + d - 1 in (0.43, 0.44)": the minimal polynomial and a decimal interval in which it has no
/// other root.
std::string to_text(const AlgebraicNumber& number);

}  // namespace folk
