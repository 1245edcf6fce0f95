#pragma once
// Numbers of 154 digits, for what happens next to d = 1, where 1-d and the incentives it scales drown in a double.

#include <folk/games/rational.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

namespace folk {

/// A binary floating-point number with 512 bits. Only sources include this header: it is a large one.
using Precise =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<512, boost::multiprecision::digit_base_2>,
                                  boost::multiprecision::et_off>;

inline Precise precise(const Integer& value) {
  return value.fits_word() ? Precise(value.word()) : Precise(value.str());
}

inline Precise precise(const Rational& value) { return precise(numerator(value)) / precise(denominator(value)); }

/// Differences below this are taken for rounding, in numbers of the size of 1: far above what rounding makes (1e-154,
/// and at most 1e16 times as much after many steps next to d = 1), far below every difference that games of
/// `finest_payoffs` make.
inline const Precise& rounding() {
  static const Precise value = ldexp(Precise(1), -400);
  return value;
}

}  // namespace folk
