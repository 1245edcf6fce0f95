#include <folk/games/error.h>
#include <folk/games/int128.h>
#include <folk/games/rational.h>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <ostream>
#include <stdexcept>
#include <utility>

namespace folk {
namespace {

// Of a number written out, and so of its numerator and denominator too.
constexpr std::size_t most_digits = 400;
// Holds every product of two words.
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

/// Reads digits from the front of `rest`.
std::string take_digits(std::string_view& rest) {
  std::string digits;
  while (!rest.empty() && is_digit(rest.front())) {
    digits += rest.front();
    rest.remove_prefix(1);
  }
  return digits;
}

Integer to_integer(const std::string& digits) { return digits.empty() ? Integer() : Integer(digits); }

bool take(std::string_view& rest, char c) {
  if (rest.empty() || rest.front() != c) return false;
  rest.remove_prefix(1);
  return true;
}

Integer power_of_ten(std::size_t exponent) { return pow(Integer(10), static_cast<unsigned>(exponent)); }

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
  std::string digits = take_digits(rest);
  if (digits.empty()) refuse(text);
  digits.erase(0, std::min(digits.find_first_not_of('0'), digits.size() - 1));
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
  return shift >= 0 ? Rational(value * power_of_ten(zeros)) : Rational(value, power_of_ten(zeros));
}

}  // namespace

// The arithmetic divides by common divisors before it multiplies (Knuth, The Art of Computer Programming 2, section
// 4.5.1): factors stay small, and mostly within a word.

Rational::Rational(const Integer& above, const Integer& below) {
  if (below.is_zero()) throw std::domain_error("a fraction has 0 below the line");
  const Integer divisor = below.sign() < 0 ? -gcd(above, below) : gcd(above, below);
  numerator_ = above / divisor;
  denominator_ = below / divisor;
}

std::string Rational::str() const {
  return denominator_ == 1 ? numerator_.str() : numerator_.str() + "/" + denominator_.str();
}

Rational Rational::operator-() const { return {LowestTerms(), -numerator_, denominator_}; }

/// a/b + c/d with the numerators added by `add`, or subtracted.
template <class Add>
Rational Rational::sum(const Rational& x, const Rational& y, Add add) {
  const Integer& a = x.numerator_;
  const Integer& b = x.denominator_;
  const Integer& c = y.numerator_;
  const Integer& d = y.denominator_;
  if (b == d) {
    const Integer above = add(a, c);
    return b == 1 ? Rational(above) : Rational(above, b);
  }
  const Integer divisor = gcd(b, d);
  if (divisor == 1) return {LowestTerms(), add(a * d, c * b), b * d};
  const Integer rest = b / divisor;
  const Integer above = add(a * (d / divisor), c * rest);
  const Integer common = gcd(above, divisor);
  return {LowestTerms(), above / common, rest * (d / common)};
}

Rational operator+(const Rational& a, const Rational& b) {
  return Rational::sum(a, b, [](const Integer& x, const Integer& y) { return x + y; });
}

Rational operator-(const Rational& a, const Rational& b) {
  return Rational::sum(a, b, [](const Integer& x, const Integer& y) { return x - y; });
}

/// a/b times c/d, both in lowest terms, b and d > 0.
Rational Rational::product(const Integer& a, const Integer& b, const Integer& c, const Integer& d) {
  if (b == 1 && d == 1) return a * c;
  const Integer across = gcd(a, d);
  const Integer back = gcd(c, b);
  return {LowestTerms(), (a / across) * (c / back), (b / back) * (d / across)};
}

Rational operator*(const Rational& a, const Rational& b) {
  return Rational::product(a.numerator_, a.denominator_, b.numerator_, b.denominator_);
}

Rational operator/(const Rational& a, const Rational& b) {
  if (b.is_zero()) throw std::domain_error("a rational was divided by 0");
  if (b.sign() > 0) return Rational::product(a.numerator_, a.denominator_, b.denominator_, b.numerator_);
  return Rational::product(a.numerator_, a.denominator_, -b.denominator_, -b.numerator_);
}

std::strong_ordering operator<=>(const Rational& a, const Rational& b) {
  if (a.denominator_ == b.denominator_) return a.numerator_ <=> b.numerator_;
  if (a.sign() != b.sign()) return a.sign() <=> b.sign();
  if (a.numerator_.fits_word() && a.denominator_.fits_word() && b.numerator_.fits_word() && b.denominator_.fits_word())
    return Int128{a.numerator_.word()} * b.denominator_.word() <=> Int128{b.numerator_.word()} * a.denominator_.word();
  return a.numerator_ * b.denominator_ <=> b.numerator_ * a.denominator_;
}

Rational abs(const Rational& value) { return value.sign() < 0 ? -value : value; }

Rational simplest_between(const Rational& low, const Rational& high) {
  const Integer whole = numerator(low) / denominator(low);
  if (whole == low) return low;
  if (whole + 1 <= high) return whole + 1;
  return whole + 1 / simplest_between(1 / (high - whole), 1 / (low - whole));
}

Rational parse_rational(std::string_view text) {
  std::string_view rest = text;
  const bool negative = take(rest, '-');
  if (!negative) take(rest, '+');
  const std::string whole = take_digits(rest);
  const Rational value = take(rest, '/') ? fraction(text, whole, take_digits(rest), rest) : decimal(text, whole, rest);
  return negative ? -value : value;
}

std::string to_text(const Rational& value) {
  const Integer& above = numerator(value);
  const Integer& below = denominator(value);
  if (below == 1) return above.str();
  // A fraction ends as a decimal iff its denominator has no prime factor but 2 and 5.
  Integer rest = below;
  std::size_t twos = 0;
  std::size_t fives = 0;
  for (; rest % 2 == 0; rest /= 2) ++twos;
  for (; rest % 5 == 0; rest /= 5) ++fives;
  const std::size_t places = std::max(twos, fives);
  const std::string as_fraction = value.str();
  if (rest != 1 || places > most_places) return as_fraction;
  const Integer scaled = abs(above) * power_of_ten(places) / below;
  std::string digits = scaled.str();
  if (digits.size() > most_digits) return as_fraction;
  if (digits.size() <= places) digits.insert(0, places + 1 - digits.size(), '0');
  digits.insert(digits.size() - places, ".");
  return (above < 0 ? "-" : "") + digits;
}

double to_double(const Rational& value) { return nearest_quotient(numerator(value), denominator(value)); }

Rational as_written(double number) { return parse_rational(fmt::format("{}", number)); }

std::string to_short_text(const Rational& value) {
  const double nearest = to_double(value);
  return std::isfinite(nearest) && value == as_written(nearest) ? fmt::format("{}", nearest) : to_text(value);
}

std::string to_short_text(double number) {
  std::string decimal = fmt::format("{}", number);
  constexpr std::size_t long_decimal = 12;
  constexpr double most = 1e6;  // of a fraction's numbers
  if (decimal.size() <= long_decimal || !(std::abs(number) < most)) return decimal;
  // Continued fractions: the convergents are the nearest fractions of their size.
  double above = 1, above_before = 0, below = 0, below_before = 1;
  for (double rest = std::abs(number); below <= most;) {
    const double whole = std::floor(rest);
    above_before = std::exchange(above, whole * above + above_before);
    below_before = std::exchange(below, whole * below + below_before);
    if (above > most || below > most) break;
    if (above / below == std::abs(number)) {
      const std::string fraction = fmt::format("{}{:.0f}/{:.0f}", number < 0 ? "-" : "", above, below);
      return fraction.size() < decimal.size() ? fraction : decimal;
    }
    rest = 1 / (rest - whole);
  }
  return decimal;
}

Rational parse_exact_number(std::string_view text, std::string_view what, double low, double high) {
  try {
    if (text.starts_with('+')) refuse(text);
    Rational value = parse_rational(text);
    // The ends are compared exactly: what is a hair beyond one may round to it.
    const double nearest = to_double(value);
    if ((nearest > low && nearest < high) || (nearest == low && value >= as_written(low)) ||
        (nearest == high && value <= as_written(high)))
      return value;
  } catch (const UsageError&) {  // no number at all: the message is the same
  }
  throw UsageError(fmt::format("{} '{}': expected a number from {} to {}", what, excerpt(text), low, high));
}

double parse_number(std::string_view text, std::string_view what, double low, double high) {
  return to_double(parse_exact_number(text, what, low, high));
}

std::optional<std::uint64_t> whole_number(std::string_view text) {
  if (text.starts_with('+') || text.starts_with('-')) return std::nullopt;
  try {
    const Rational value = parse_rational(text);
    const std::string digits = value.str();
    const char* end = digits.data() + digits.size();
    std::uint64_t number = 0;
    const auto [stop, error] = std::from_chars(digits.data(), end, number);
    if (error == std::errc() && stop == end) return number;
  } catch (const UsageError&) {  // no number at all
  }
  return std::nullopt;
}

std::uint64_t parse_whole_number(std::string_view text, std::string_view what, std::uint64_t low, std::uint64_t high) {
  const auto number = whole_number(text);
  if (!number || *number < low || *number > high)
    throw UsageError(fmt::format("{} '{}': expected a whole number from {} to {}", what, excerpt(text), low, high));
  return *number;
}

std::ostream& operator<<(std::ostream& out, const Rational& value) { return out << value.str(); }

}  // namespace folk
