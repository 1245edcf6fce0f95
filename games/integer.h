#pragma once
// Exact whole numbers of any size.

#include <compare>
#include <concepts>
#include <cstdint>
#include <iosfwd>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

namespace folk {

/// An exact integer of unbounded size. One that fits 64 bits is kept in place: its arithmetic is the processor's,
/// watched for overflow. Only a larger one is an object of the big-number library, which integer.cpp alone includes.
class Integer {
public:
  Integer() = default;

  template <std::integral T>
  Integer(T value)  // NOLINT(google-explicit-constructor): every whole number is one
      : word_(static_cast<std::int64_t>(value)) {
    if constexpr (std::unsigned_integral<T> && sizeof(T) == sizeof(std::uint64_t))
      if (value > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max())) become_large(value);
  }

  /// Reads decimal digits with or without a minus sign. Throws std::invalid_argument on anything else.
  explicit Integer(std::string_view digits);

  Integer(const Integer& other)
      : word_(other.word_),
        large_(other.large_ ? copy(*other.large_) : nullptr) {}
  Integer(Integer&& other) noexcept
      : word_(other.word_),
        large_(std::exchange(other.large_, nullptr)) {}
  Integer& operator=(const Integer& other) {
    if (large_ || other.large_) return *this = Integer(other);
    word_ = other.word_;
    return *this;
  }
  Integer& operator=(Integer&& other) noexcept {
    std::swap(word_, other.word_);
    std::swap(large_, other.large_);
    return *this;
  }
  ~Integer() {
    if (large_) destroy(large_);
  }

  /// True from -2^63 to 2^63 - 1: then `word` is the number.
  bool fits_word() const { return !large_; }
  std::int64_t word() const { return word_; }

  bool is_zero() const { return !large_ && word_ == 0; }
  /// -1, 0 or 1.
  int sign() const { return large_ ? large_sign() : (word_ > 0) - (word_ < 0); }

  /// The decimal digits, after a minus sign where it is negative.
  std::string str() const;

  Integer operator-() const { return Integer() - *this; }
  Integer& operator+=(const Integer& other) {
    std::int64_t sum = 0;
    if (large_ || other.large_ || __builtin_add_overflow(word_, other.word_, &sum)) return add_large(other);
    word_ = sum;
    return *this;
  }
  Integer& operator-=(const Integer& other) {
    std::int64_t difference = 0;
    if (large_ || other.large_ || __builtin_sub_overflow(word_, other.word_, &difference)) return subtract_large(other);
    word_ = difference;
    return *this;
  }
  Integer& operator*=(const Integer& other) {
    std::int64_t product = 0;
    if (large_ || other.large_ || __builtin_mul_overflow(word_, other.word_, &product)) return multiply_large(other);
    word_ = product;
    return *this;
  }
  /// Rounds towards 0. Throws std::domain_error when `other` is 0.
  Integer& operator/=(const Integer& other) {
    if (large_ || other.large_ || other.word_ == 0 || other.word_ == -1) return divide_large(other);
    word_ /= other.word_;
    return *this;
  }
  /// What is left of that division, with the sign of the dividend. Throws std::domain_error when `other` is 0.
  Integer& operator%=(const Integer& other) {
    if (large_ || other.large_ || other.word_ == 0 || other.word_ == -1) return take_large_remainder(other);
    word_ %= other.word_;
    return *this;
  }
  Integer& operator<<=(unsigned bits);

  friend Integer operator+(const Integer& a, const Integer& b) {
    std::int64_t sum = 0;
    if (a.large_ || b.large_ || __builtin_add_overflow(a.word_, b.word_, &sum)) return large_sum(a, b);
    return sum;
  }
  friend Integer operator-(const Integer& a, const Integer& b) {
    std::int64_t difference = 0;
    if (a.large_ || b.large_ || __builtin_sub_overflow(a.word_, b.word_, &difference)) return large_difference(a, b);
    return difference;
  }
  friend Integer operator*(const Integer& a, const Integer& b) {
    std::int64_t product = 0;
    if (a.large_ || b.large_ || __builtin_mul_overflow(a.word_, b.word_, &product)) return large_product(a, b);
    return product;
  }
  friend Integer operator/(Integer a, const Integer& b) { return std::move(a /= b); }
  friend Integer operator%(Integer a, const Integer& b) { return std::move(a %= b); }
  friend Integer operator<<(Integer a, unsigned bits) { return std::move(a <<= bits); }

  friend bool operator==(const Integer& a, const Integer& b) {
    return a.large_ || b.large_ ? large_order(a, b) == 0 : a.word_ == b.word_;
  }
  friend std::strong_ordering operator<=>(const Integer& a, const Integer& b) {
    return a.large_ || b.large_ ? large_order(a, b) <=> 0 : a.word_ <=> b.word_;
  }

private:
  struct Large;

  static Large* copy(const Large& large);
  static void destroy(Large* large);
  static Integer large_sum(const Integer& a, const Integer& b);
  static Integer large_difference(const Integer& a, const Integer& b);
  static Integer large_product(const Integer& a, const Integer& b);
  static int large_order(const Integer& a, const Integer& b);
  void become_large(std::uint64_t value);
  int large_sign() const;
  Integer& add_large(const Integer& other);
  Integer& subtract_large(const Integer& other);
  Integer& multiply_large(const Integer& other);
  Integer& divide_large(const Integer& other);
  Integer& take_large_remainder(const Integer& other);
  /// Calls with the large number, made of the word where there is none yet; then back to a word where it fits.
  template <class Change>
  Integer& change_large(Change change);

  friend Integer gcd(const Integer& a, const Integer& b);
  friend Integer pow(const Integer& base, unsigned exponent);
  friend double nearest_quotient(const Integer& above, const Integer& below);
  friend double to_double(const Integer& value);

  std::int64_t word_ = 0;   // 0 beside a large number
  Large* large_ = nullptr;  // own; what does not fit a word, and nothing else
};

Integer abs(const Integer& value);

/// The greatest common divisor, >= 0; 0 of two zeros.
Integer gcd(const Integer& a, const Integer& b);

/// The least common multiple, >= 0.
Integer lcm(const Integer& a, const Integer& b);

Integer pow(const Integer& base, unsigned exponent);

double to_double(const Integer& value);

/// The double nearest to above / below; `below` > 0.
double nearest_quotient(const Integer& above, const Integer& below);

std::ostream& operator<<(std::ostream& out, const Integer& value);

}  // namespace folk
