#pragma once
// Exact numbers: payoffs are kept as the decimal or fraction that a person wrote.

#include <folk/games/integer.h>

#include <compare>
#include <concepts>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace folk {

/// An exact rational of unbounded size, always in lowest terms.
class Rational {
public:
  Rational() = default;

  template <std::integral T>
  Rational(T value)  // NOLINT(google-explicit-constructor): every whole number is rational
      : numerator_(value) {}
  Rational(Integer value)  // NOLINT(google-explicit-constructor)
      : numerator_(std::move(value)) {}

  /// above / below. Throws std::domain_error when `below` is 0.
  Rational(const Integer& above, const Integer& below);

  const Integer& numerator() const& { return numerator_; }
  Integer numerator() && { return std::move(numerator_); }
  /// > 0.
  const Integer& denominator() const& { return denominator_; }
  Integer denominator() && { return std::move(denominator_); }

  bool is_zero() const { return numerator_.is_zero(); }
  /// -1, 0 or 1.
  int sign() const { return numerator_.sign(); }

  /// "3", "-5/4": a fraction, never a decimal.
  std::string str() const;

  Rational operator-() const;
  Rational& operator+=(const Rational& other) { return *this = *this + other; }
  Rational& operator-=(const Rational& other) { return *this = *this - other; }
  Rational& operator*=(const Rational& other) { return *this = *this * other; }
  Rational& operator/=(const Rational& other) { return *this = *this / other; }

  friend Rational operator+(const Rational& a, const Rational& b);
  friend Rational operator-(const Rational& a, const Rational& b);
  friend Rational operator*(const Rational& a, const Rational& b);
  /// Throws std::domain_error when `b` is 0.
  friend Rational operator/(const Rational& a, const Rational& b);
  friend bool operator==(const Rational& a, const Rational& b) {
    return a.numerator_ == b.numerator_ && a.denominator_ == b.denominator_;
  }
  friend std::strong_ordering operator<=>(const Rational& a, const Rational& b);

private:
  struct LowestTerms {};
  Rational(LowestTerms, Integer above, Integer below)
      : numerator_(std::move(above)),
        denominator_(std::move(below)) {}

  template <class Add>
  static Rational sum(const Rational& x, const Rational& y, Add add);
  static Rational product(const Integer& a, const Integer& b, const Integer& c, const Integer& d);

  Integer numerator_;
  Integer denominator_ = 1;
};

inline const Integer& numerator(const Rational& value) { return value.numerator(); }
inline Integer numerator(Rational&& value) { return std::move(value).numerator(); }
inline const Integer& denominator(const Rational& value) { return value.denominator(); }
inline Integer denominator(Rational&& value) { return std::move(value).denominator(); }

Rational abs(const Rational& value);

/// The fraction of the smallest denominator in [low, high], 0 <= low < high (Stern-Brocot, by continued fractions).
Rational simplest_between(const Rational& low, const Rational& high);

/// Reads "3", "-1.25", "2.5e-3" or "1/3" exactly.
/// Throws UsageError on anything else, and on numbers of more than 400 digits once written out without an exponent
/// (of a fraction: above or below the line).
Rational parse_rational(std::string_view text);

/// An exact text: "3", "-1.25" where the decimal ends within 100 places, else "1/3". What parse_rational gave is read
/// back by it.
std::string to_text(const Rational& value);

/// The nearest double.
double to_double(const Rational& value);

/// What a person wrote who meant this double: the shortest decimal that reads back as it, so that 0.1 is a tenth.
/// Throws UsageError for what is no number.
Rational as_written(double number);

/// As it is shown in names: the shortest decimal of the nearest double where that is the number itself ("0.3",
/// "1e-07"), else to_text ("1/3"). What parse_rational gave is read back by it.
std::string to_short_text(const Rational& value);

/// A double as it is shown: the shortest decimal that reads back as it, or a fraction of small numbers where that is
/// shorter than a long decimal ("0.1", "1/3").
std::string to_short_text(double number);

// How every number of an option, a strategy's parameter or a machine file is read: exactly, and only then rounded.

/// Reads what parse_rational reads, but no '+', from `low` to `high`; `what` names it in the message. Throws
/// UsageError.
Rational parse_exact_number(std::string_view text, std::string_view what, double low, double high);

/// The double nearest to it.
double parse_number(std::string_view text, std::string_view what, double low, double high);

/// The whole number that a text without a sign stands for: "1000", "1e3", "2.5e3". Nothing for any other text and
/// beyond 64 bits.
std::optional<std::uint64_t> whole_number(std::string_view text);

/// whole_number from `low` to `high`; `what` names it in the message. Throws UsageError.
std::uint64_t parse_whole_number(std::string_view text, std::string_view what, std::uint64_t low, std::uint64_t high);

std::ostream& operator<<(std::ostream& out, const Rational& value);

}  // namespace folk
