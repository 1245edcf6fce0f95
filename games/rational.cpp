#include <folk/games/error.h>
#include <folk/games/rational.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>

namespace folk {
namespace {

using Integer = boost::multiprecision::cpp_int;

// Of a number written out, and so of its numerator and denominator too.
constexpr std::size_t most_digits = 400;
// Decimals with more places are shown as fractions.
constexpr std::size_t most_places = 100;

[[noreturn]] void refuse(std::string_view text) {
  throw UsageError("'" + excerpt(text) + "' is not a number: write it as 3, -1.25, 2.5e-3 or 1/3");
}

[[noreturn]] void refuse_size(std::string_view text) {
  throw UsageError("'" + excerpt(text) + "' has more than " + std::to_string(most_digits) +
                   " digits: write a shorter number");
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Reads digits from the front of `rest`; leading zeros are dropped because they would say "octal" to the library.
std::string take_digits(std::string_view& rest) {
  std::string digits;
  while (!rest.empty() && is_digit(rest.front())) {
    digits += rest.front();
    rest.remove_prefix(1);
  }
  return digits;
}

Integer to_integer(const std::string& digits) {
  const auto first = digits.find_first_not_of('0');
  return first == std::string::npos ? Integer(0) : Integer(digits.substr(first));
}

bool take(std::string_view& rest, char c) {
  if (rest.empty() || rest.front() != c) return false;
  rest.remove_prefix(1);
  return true;
}

Integer power_of_ten(std::size_t exponent) {
  return boost::multiprecision::pow(Integer(10), static_cast<unsigned>(exponent));
}

/// The number above/below; `rest` is what follows it in `text`.
Rational fraction(std::string_view text, const std::string& above, const std::string& below, std::string_view rest) {
  if (above.empty() || below.empty() || !rest.empty()) refuse(text);
  if (above.size() > most_digits || below.size() > most_digits) refuse_size(text);
  const Integer denominator = to_integer(below);
  if (denominator == 0)
    throw UsageError("'" + excerpt(text) + "' divides by zero: write a number other than 0 below the line");
  return Rational(to_integer(above), denominator);
}

/// Reads e3, E+3, e-3 or nothing.
long take_exponent(std::string_view text, std::string_view& rest) {
  if (!take(rest, 'e') && !take(rest, 'E')) return 0;
  const bool down = take(rest, '-');
  if (!down) take(rest, '+');
  const std::string digits = take_digits(rest);
  if (digits.empty()) refuse(text);
  if (digits.size() > 4) refuse_size(text);
  const long exponent = std::strtol(digits.c_str(), nullptr, 10);
  return down ? -exponent : exponent;
}

/// The decimal whose whole part is read already.
Rational decimal(std::string_view text, const std::string& whole, std::string_view rest) {
  const std::string places = take(rest, '.') ? take_digits(rest) : "";
  if (whole.empty() && places.empty()) refuse(text);
  const long exponent = take_exponent(text, rest);
  if (!rest.empty()) refuse(text);
  const std::string digits = whole + places;
  const long shift = exponent - static_cast<long>(places.size());
  const std::size_t zeros = static_cast<std::size_t>(std::labs(shift));
  // A denominator of 10^n has n + 1 digits.
  if (digits.size() + (shift > 0 ? zeros : 0) > most_digits || zeros >= most_digits) refuse_size(text);
  const Integer value = to_integer(digits);
  return shift >= 0 ? Rational(Integer(value * power_of_ten(zeros))) : Rational(value, power_of_ten(zeros));
}

}  // namespace

Rational parse_rational(std::string_view text) {
  std::string_view rest = text;
  const bool negative = take(rest, '-');
  if (!negative) take(rest, '+');
  const std::string whole = take_digits(rest);
  const Rational value = take(rest, '/') ? fraction(text, whole, take_digits(rest), rest) : decimal(text, whole, rest);
  return negative ? Rational(-value) : value;
}

std::string to_text(const Rational& value) {
  const Integer above = numerator(value);
  const Integer below = denominator(value);
  if (below == 1) return above.str();
  // A fraction ends as a decimal iff its denominator has no prime factor but 2 and 5.
  Integer rest = below;
  std::size_t twos = 0;
  std::size_t fives = 0;
  for (; rest % 2 == 0; rest /= 2) ++twos;
  for (; rest % 5 == 0; rest /= 5) ++fives;
  const std::size_t places = std::max(twos, fives);
  const std::string as_fraction = above.str() + "/" + below.str();
  if (rest != 1 || places > most_places) return as_fraction;
  const Integer scaled = abs(above) * power_of_ten(places) / below;
  std::string digits = scaled.str();
  if (digits.size() > most_digits) return as_fraction;
  if (digits.size() <= places) digits.insert(0, places + 1 - digits.size(), '0');
  digits.insert(digits.size() - places, ".");
  return (above < 0 ? "-" : "") + digits;
}

double to_double(const Rational& value) { return value.convert_to<double>(); }

}  // namespace folk
