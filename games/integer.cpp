#include <folk/games/integer.h>

#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <ostream>
#include <stdexcept>

namespace folk {
namespace {

using boost::multiprecision::cpp_int;

constexpr std::int64_t least_word = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t most_word = std::numeric_limits<std::int64_t>::max();

/// |value|; that of the least word has no word with a sign.
std::uint64_t size_of(std::int64_t value) {
  return value < 0 ? -static_cast<std::uint64_t>(value) : static_cast<std::uint64_t>(value);
}

[[noreturn]] void refuse_zero() { throw std::domain_error("an exact number was divided by 0"); }

/// above / below, smaller than any normal double, in units of the smallest one; half a unit goes to the even number.
double nearest_subnormal(const Integer& above, const Integer& below) {
  constexpr unsigned bits = 1074;  // the smallest double is 2^-1074
  const Integer scaled = abs(above) << bits;
  Integer units = scaled / below;
  const Integer rest = (scaled - units * below) * 2;
  if (rest > below || (rest == below && units % 2 == 1)) units += 1;
  const double nearest = std::ldexp(to_double(units), -static_cast<int>(bits));
  return above.sign() < 0 ? -nearest : nearest;
}

}  // namespace

struct Integer::Large {
  cpp_int value;

  /// `number` in the library's form: as it stands, or made of its word in `room`.
  static const cpp_int& of(const Integer& number, cpp_int& room) {
    if (number.large_) return number.large_->value;
    return room = number.word_;
  }

  /// A number that may fit a word.
  static Integer settled(cpp_int value) {
    Integer number;
    if (value >= least_word && value <= most_word)
      number.word_ = static_cast<std::int64_t>(value);
    else
      number.large_ = new Large{std::move(value)};
    return number;
  }

  /// A function of two numbers in the library's form.
  template <class Combine>
  static Integer combined(const Integer& a, const Integer& b, Combine combine) {
    cpp_int room_of_a;
    cpp_int room_of_b;
    cpp_int result;
    combine(result, of(a, room_of_a), of(b, room_of_b));
    return settled(std::move(result));
  }
};

Integer::Large* Integer::copy(const Large& large) { return new Large(large); }

void Integer::destroy(Large* large) { delete large; }

Integer::Integer(std::string_view digits) {
  const bool negative = digits.starts_with('-');
  if (negative) digits.remove_prefix(1);
  if (digits.empty() || !std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; }))
    throw std::invalid_argument("an integer is read from decimal digits");
  digits.remove_prefix(std::min(digits.find_first_not_of('0'), digits.size()));
  if (digits.empty()) return;
  const cpp_int value{std::string(digits)};
  *this = Large::settled(negative ? cpp_int(-value) : value);
}

std::string Integer::str() const { return large_ ? large_->value.str() : std::to_string(word_); }

int Integer::large_sign() const { return large_->value.sign(); }

void Integer::become_large(std::uint64_t value) {
  word_ = 0;
  large_ = new Large{cpp_int(value)};
}

template <class Change>
Integer& Integer::change_large(Change change) {
  if (!large_) {
    large_ = new Large{cpp_int(word_)};
    word_ = 0;
  }
  change(large_->value);
  if (large_->value >= least_word && large_->value <= most_word) {
    word_ = static_cast<std::int64_t>(large_->value);
    delete std::exchange(large_, nullptr);
  }
  return *this;
}

Integer& Integer::add_large(const Integer& other) {
  cpp_int room;
  return change_large([&, &number = Large::of(other, room)](cpp_int& value) { value += number; });
}

Integer& Integer::subtract_large(const Integer& other) {
  cpp_int room;
  return change_large([&, &number = Large::of(other, room)](cpp_int& value) { value -= number; });
}

Integer& Integer::multiply_large(const Integer& other) {
  cpp_int room;
  return change_large([&, &number = Large::of(other, room)](cpp_int& value) { value *= number; });
}

Integer& Integer::divide_large(const Integer& other) {
  if (other.is_zero()) refuse_zero();
  cpp_int room;
  return change_large([&, &number = Large::of(other, room)](cpp_int& value) { value /= number; });
}

Integer& Integer::take_large_remainder(const Integer& other) {
  if (other.is_zero()) refuse_zero();
  cpp_int room;
  return change_large([&, &number = Large::of(other, room)](cpp_int& value) { value %= number; });
}

Integer& Integer::operator<<=(unsigned bits) {
  return change_large([bits](cpp_int& value) { value <<= bits; });
}

Integer Integer::large_sum(const Integer& a, const Integer& b) {
  return Large::combined(a, b, [](cpp_int& sum, const cpp_int& x, const cpp_int& y) { sum = x + y; });
}

Integer Integer::large_difference(const Integer& a, const Integer& b) {
  return Large::combined(a, b, [](cpp_int& difference, const cpp_int& x, const cpp_int& y) { difference = x - y; });
}

Integer Integer::large_product(const Integer& a, const Integer& b) {
  return Large::combined(a, b, [](cpp_int& product, const cpp_int& x, const cpp_int& y) { product = x * y; });
}

int Integer::large_order(const Integer& a, const Integer& b) {
  if (!a.large_) return -b.sign();
  if (!b.large_) return a.sign();
  return a.large_->value.compare(b.large_->value);
}

Integer abs(const Integer& value) { return value.sign() < 0 ? -value : value; }

Integer gcd(const Integer& a, const Integer& b) {
  if (!a.large_ && !b.large_) return std::gcd(size_of(a.word_), size_of(b.word_));
  return Integer::Large::combined(
      a, b, [](cpp_int& divisor, const cpp_int& x, const cpp_int& y) { divisor = boost::multiprecision::gcd(x, y); });
}

Integer lcm(const Integer& a, const Integer& b) {
  return a.is_zero() || b.is_zero() ? Integer() : abs(a / gcd(a, b) * b);
}

Integer pow(const Integer& base, unsigned exponent) {
  cpp_int room;
  return Integer::Large::settled(boost::multiprecision::pow(Integer::Large::of(base, room), exponent));
}

double to_double(const Integer& value) {
  return value.large_ ? value.large_->value.convert_to<double>() : static_cast<double>(value.word_);
}

double nearest_quotient(const Integer& above, const Integer& below) {
  // Whole numbers up to 2^53 are doubles, and their quotient is rounded once.
  constexpr std::int64_t most_exact = std::int64_t{1} << 53;
  if (!above.large_ && !below.large_ && above.word_ >= -most_exact && above.word_ <= most_exact &&
      below.word_ <= most_exact)
    return static_cast<double>(above.word_) / static_cast<double>(below.word_);
  cpp_int room_above;
  cpp_int room_below;
  const double nearest =
      boost::multiprecision::cpp_rational(Integer::Large::of(above, room_above), Integer::Large::of(below, room_below))
          .convert_to<double>();
  // Below the normal doubles the library rounds to 53 bits and then again to those that are left.
  return std::abs(nearest) <= std::numeric_limits<double>::min() && !above.is_zero() ? nearest_subnormal(above, below)
                                                                                     : nearest;
}

std::ostream& operator<<(std::ostream& out, const Integer& value) { return out << value.str(); }

}  // namespace folk
