#include <folk/games/integer.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "games/arbitrary.h"

namespace folk {
namespace {

using boost::multiprecision::cpp_int;

constexpr std::int64_t least_word = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t most_word = std::numeric_limits<std::int64_t>::max();

cpp_int reference(const Integer& value) { return cpp_int(value.str()); }

/// Equal, and kept as it must be: a number that fits a word in one.
/// One object by two names: a compiler warns of x -= x.
const Integer& itself(const Integer& value) { return value; }

void expect_same(const Integer& value, const cpp_int& expected) {
  RC_ASSERT(value.str() == expected.str());
  RC_ASSERT(value.fits_word() == (expected >= least_word && expected <= most_word));
  if (value.fits_word()) RC_ASSERT(value.word() == static_cast<std::int64_t>(expected));
}

RC_GTEST_PROP(Integer, SumsDifferencesAndProductsAreTheLibrarys, (const Integer& a, const Integer& b)) {
  expect_same(a + b, reference(a) + reference(b));
  expect_same(a - b, reference(a) - reference(b));
  expect_same(a * b, reference(a) * reference(b));
  expect_same(-a, -reference(a));
  expect_same(abs(a), abs(reference(a)));
}

RC_GTEST_PROP(Integer, ChangesInPlaceAreTheOperators, (const Integer& a, const Integer& b)) {
  Integer changed = a;
  expect_same(changed += b, reference(a) + reference(b));
  expect_same(changed -= b, reference(a));
  expect_same(changed *= b, reference(a) * reference(b));
  if (b.is_zero()) return;
  expect_same(changed /= b, reference(a));
  expect_same(changed %= b, reference(a) % reference(b));
}

RC_GTEST_PROP(Integer, ANumberMayMeetItself, (const Integer& a)) {
  const cpp_int expected = reference(a);
  Integer changed = a;
  expect_same(changed += itself(changed), expected + expected);
  changed = a;
  expect_same(changed *= itself(changed), expected * expected);
  changed = a;
  expect_same(changed -= itself(changed), 0);
  if (a.is_zero()) return;
  changed = a;
  expect_same(changed /= itself(changed), 1);
  changed = a;
  expect_same(changed %= itself(changed), 0);
}

RC_GTEST_PROP(Integer, QuotientsAndCommonDivisorsAreTheLibrarys, (const Integer& a, const Integer& b)) {
  RC_PRE(!b.is_zero());
  expect_same(a / b, reference(a) / reference(b));
  expect_same(a % b, reference(a) % reference(b));
  expect_same(gcd(a, b), gcd(reference(a), reference(b)));
  expect_same(lcm(a, b), a.is_zero() ? cpp_int(0) : cpp_int(lcm(reference(a), reference(b))));
}

RC_GTEST_PROP(Integer, PowersAreTheLibrarys, (const Integer& a)) {
  const auto exponent = *rc::gen::inRange(0U, 9U);
  expect_same(pow(a, exponent), boost::multiprecision::pow(reference(a), exponent));
  expect_same(a << 13 * exponent, reference(a) * boost::multiprecision::pow(cpp_int(2), 13 * exponent));
}

RC_GTEST_PROP(Integer, OrderAndSignAreTheLibrarys, (const Integer& a, const Integer& b)) {
  RC_ASSERT((a < b) == (reference(a) < reference(b)));
  RC_ASSERT((a > b) == (reference(a) > reference(b)));
  RC_ASSERT((a == b) == (reference(a) == reference(b)));
  RC_ASSERT(a < a + 1);
  RC_ASSERT(a == Integer(a));
  RC_ASSERT(a.sign() == reference(a).sign());
  RC_ASSERT(a.is_zero() == reference(a).is_zero());
}

RC_GTEST_PROP(Integer, TextsAndDoublesAreTheLibrarys, (const Integer& a, const Integer& b)) {
  RC_ASSERT(Integer(a.str()) == a);
  RC_ASSERT(to_double(a) == reference(a).convert_to<double>());
  RC_PRE(!b.is_zero());
  RC_ASSERT(nearest_quotient(a, abs(b)) ==
            boost::multiprecision::cpp_rational(reference(a), abs(reference(b))).convert_to<double>());
}

RC_GTEST_PROP(Integer, CopiesAndMovesKeepTheNumber, (const Integer& a, const Integer& b)) {
  Integer copy = a;
  Integer moved = std::move(copy);
  expect_same(moved, reference(a));
  copy = b;
  moved = copy;
  expect_same(moved, reference(b));
  copy += 1;  // not the same object
  expect_same(moved, reference(b));
  moved = std::move(copy);
  expect_same(moved, reference(b) + 1);
  const Integer& same = moved;
  moved = same;
  expect_same(moved, reference(b) + 1);
}

TEST(Integer, ComesFromEveryWholeType) {
  EXPECT_EQ(Integer().str(), "0");
  EXPECT_EQ(Integer(std::numeric_limits<std::uint64_t>::max()).str(), "18446744073709551615");
  EXPECT_EQ(Integer(static_cast<std::uint64_t>(most_word)).str(), "9223372036854775807");
  EXPECT_EQ(Integer(least_word).str(), "-9223372036854775808");
  EXPECT_EQ(Integer(std::numeric_limits<std::uint32_t>::max()).str(), "4294967295");
  EXPECT_EQ(Integer(true), Integer(1));
  EXPECT_EQ((-Integer(least_word)).str(), "9223372036854775808");
  EXPECT_EQ((Integer(least_word) / -1).str(), "9223372036854775808");
  EXPECT_EQ(Integer(least_word) % -1, 0);
  EXPECT_EQ(Integer(least_word) * -1, Integer(1) << 63);
  EXPECT_EQ(gcd(Integer(least_word), Integer(least_word)), Integer(1) << 63);
}

TEST(Integer, ReadsDecimalDigits) {
  EXPECT_EQ(Integer("010"), 10);
  EXPECT_EQ(Integer("-000"), 0);
  EXPECT_EQ(Integer("-12"), -12);
  for (const char* text : {"", "-", "+1", "1.5", "0x1", " 1", "--1"})
    EXPECT_THROW(Integer{std::string_view(text)}, std::invalid_argument) << text;
  std::ostringstream out;
  out << Integer("123456789012345678901234567890");
  EXPECT_EQ(out.str(), "123456789012345678901234567890");
}

TEST(Integer, RefusesToDivideByZero) {
  for (const Integer& number : {Integer(7), Integer(1) << 100}) {
    EXPECT_THROW(number / 0, std::domain_error);
    EXPECT_THROW(number % 0, std::domain_error);
  }
}

}  // namespace
}  // namespace folk
