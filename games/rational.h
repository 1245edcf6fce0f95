#pragma once
// Exact numbers: payoffs are kept as the decimal or fraction that a person wrote.

#include <boost/multiprecision/cpp_int.hpp>
#include <string>
#include <string_view>

namespace folk {

/// An exact rational of unbounded size.
using Rational =
    boost::multiprecision::number<boost::multiprecision::cpp_rational_backend, boost::multiprecision::et_off>;

/// Reads "3", "-1.25", "2.5e-3" or "1/3" exactly.
/// Throws UsageError on anything else, and on numbers of more than 400 digits once written out without an exponent
/// (of a fraction: above or below the line).
Rational parse_rational(std::string_view text);

/// An exact text: "3", "-1.25" where the decimal ends within 100 places, else "1/3". What parse_rational gave is read
/// back by it.
std::string to_text(const Rational& value);

/// The nearest double.
double to_double(const Rational& value);

}  // namespace folk
