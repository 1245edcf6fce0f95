#include <fmt/format.h>
#include <folk/games/rational.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "games/arbitrary.h"
#include "games/expect_error.h"

namespace folk {
namespace {

using boost::multiprecision::cpp_rational;
using test::expect_error;

/// The rational of two numbers of any size.
Rational quotient(const Integer& above, const Integer& below) {
  RC_PRE(!below.is_zero());
  return Rational(above, below);
}

/// The library's, which refuses 0 over a negative number.
cpp_rational reference(const Integer& above, const Integer& below) {
  const boost::multiprecision::cpp_int numerator(above.str());
  const boost::multiprecision::cpp_int denominator(below.str());
  return denominator < 0 ? cpp_rational(-numerator, -denominator) : cpp_rational(numerator, denominator);
}

void expect_same(const Rational& value, const cpp_rational& expected) {
  RC_ASSERT(value.str() == expected.str());
  RC_ASSERT(value.denominator() > 0);
  RC_ASSERT(gcd(value.numerator(), value.denominator()) == 1);
}

TEST(Rational, ReadsExactly) {
  EXPECT_EQ(parse_rational("3"), Rational(3));
  EXPECT_EQ(parse_rational("+3"), Rational(3));
  EXPECT_EQ(parse_rational("-1.25"), Rational(-5, 4));
  EXPECT_EQ(parse_rational("2.5e-3"), Rational(1, 400));
  EXPECT_EQ(parse_rational("1E2"), Rational(100));
  EXPECT_EQ(parse_rational(".5"), Rational(1, 2));
  EXPECT_EQ(parse_rational("5."), Rational(5));
  EXPECT_EQ(parse_rational("-4/6"), Rational(-2, 3));
  EXPECT_EQ(parse_rational("0.1") + parse_rational("0.2"), parse_rational("0.3"));
}

TEST(Rational, LeadingZerosAreDecimal) {
  EXPECT_EQ(parse_rational("010"), Rational(10));
  EXPECT_EQ(parse_rational("010/08"), Rational(5, 4));
  EXPECT_EQ(parse_rational("-0"), Rational(0));
  EXPECT_EQ(to_text(parse_rational("-0.0")), "0");
}

TEST(Rational, PrintsDecimalsThatEndAndElseFractions) {
  EXPECT_EQ(to_text(Rational(3)), "3");
  EXPECT_EQ(to_text(Rational(-5, 4)), "-1.25");
  EXPECT_EQ(to_text(Rational(1, 400)), "0.0025");
  EXPECT_EQ(to_text(Rational(-1, 1000)), "-0.001");
  EXPECT_EQ(to_text(Rational(2, 6)), "1/3");
  EXPECT_EQ(to_text(Rational(-7, 12)), "-7/12");
}

TEST(Rational, RefusesWhatIsNoNumber) {
  for (const char* text : {"",      "+",   "-",   ".",    "e5",   "1e",       "1e+",   "1.2.3", "--1",      "+-1",
                           " 1",    "1 ",  "1,5", "0x10", "1/",   "/2",       "1/-2",  "1//2",  "1/2/3",    "1.5/2",
                           "1/2e3", "nan", "NaN", "inf",  "-inf", "infinity", "1_000", "1e1.5", "\xC2\xBD", "1\n"})
    expect_error<UsageError>([&] { parse_rational(text); }, "is not a number: write it as 3, -1.25, 2.5e-3 or 1/3");
  expect_error<UsageError>([] { parse_rational(std::string_view("1\0", 2)); }, "is not a number");
}

TEST(Rational, RefusesDivisionByZero) {
  for (const char* text : {"1/0", "0/0", "-1/000"})
    expect_error<UsageError>([&] { parse_rational(text); }, "divides by zero");
}

TEST(Rational, RefusesNumbersOfMoreThan400Digits) {
  const std::string digits(400, '9');
  EXPECT_EQ(to_text(parse_rational(digits)), digits);
  EXPECT_EQ(parse_rational("1e399"), parse_rational("1" + std::string(399, '0')));
  EXPECT_EQ(parse_rational("1/1" + std::string(399, '0')), parse_rational("1e-399"));
  for (const std::string& text : {digits + "9", "1/" + digits + "9", digits + "9/2", std::string("1e400"),
                                  std::string("1e-400"), std::string("1e99999999999999999999"), digits + ".5"})
    expect_error<UsageError>([&] { parse_rational(text); }, "has more than 400 digits: write a shorter number");
}

TEST(Rational, ExtremesAreReadBack) {
  for (const std::string& text :
       {std::string("1e-399"), std::string("1e399"), std::string("-1.5e-300"), std::string("1e-100"),
        std::string("1e-101"), std::string(400, '7') + "/2", std::string(400, '7') + "/1024",
        std::string(300, '7') + "." + std::string(100, '3'), std::string("0.") + std::string(399, '3')}) {
    const Rational value = parse_rational(text);
    EXPECT_EQ(parse_rational(to_text(value)), value) << text;
  }
}

RC_GTEST_PROP(Rational, TextIsReadBack, (const Rational& value)) { RC_ASSERT(parse_rational(to_text(value)) == value); }

RC_GTEST_PROP(Rational, EveryDecimalTextIsReadBack, (bool negative, std::uint32_t whole, std::uint32_t places)) {
  const auto exponent = *rc::gen::inRange(-350, 350);
  const std::string text = fmt::format("{}{}.{}e{}", negative ? "-" : "", whole, places, exponent);
  const Rational value = parse_rational(text);
  RC_ASSERT(parse_rational(to_text(value)) == value);
}

// The other way round: a double's shortest text is read exactly and comes back as that double.
RC_GTEST_PROP(Rational, NearestDouble, (std::int64_t mantissa)) {
  const int exponent = *rc::gen::inRange(-900, 900);
  const double value = std::ldexp(static_cast<double>(mantissa), exponent);
  RC_ASSERT(to_double(parse_rational(fmt::format("{}", value))) == value);
}

TEST(Rational, DoublesOfLargeFractions) {
  EXPECT_EQ(to_double(parse_rational(std::string(400, '9') + "/" + std::string(400, '9'))), 1.0);
  EXPECT_EQ(to_double(parse_rational("1/" + std::string(330, '3'))), 0.0);
  EXPECT_EQ(to_double(Rational(1, 3)), 1.0 / 3.0);
}

RC_GTEST_PROP(Rational, ArithmeticIsTheLibrarys,
              (const Integer& a, const Integer& b, const Integer& c, const Integer& d)) {
  const Rational x = quotient(a, b);
  const Rational y = quotient(c, d);
  const cpp_rational exact_x = reference(a, b);
  const cpp_rational exact_y = reference(c, d);
  expect_same(x, exact_x);
  expect_same(x + y, exact_x + exact_y);
  expect_same(x - y, exact_x - exact_y);
  expect_same(x * y, exact_x * exact_y);
  expect_same(-x, -exact_x);
  expect_same(abs(x), abs(exact_x));
  RC_ASSERT((x < y) == (exact_x < exact_y));
  RC_ASSERT((x > y) == (exact_x > exact_y));
  RC_ASSERT((x == y) == (exact_x == exact_y));
  RC_ASSERT(x.sign() == exact_x.sign());
  RC_ASSERT(x.is_zero() == (exact_x == 0));
  RC_ASSERT(to_double(x) == exact_x.convert_to<double>());
  if (y == 0) return;
  expect_same(x / y, exact_x / exact_y);
}

RC_GTEST_PROP(Rational, ArithmeticWithCommonDenominatorsIsTheLibrarys, (const Integer& a, const Integer& c)) {
  const auto number = rc::gen::inRange<std::int64_t>(1, 40);
  const std::int64_t common = *number * (std::int64_t{1} << *rc::gen::inRange(0, 57));
  const Integer b = Integer(common) * *number;
  const Integer d = Integer(common) * *number;
  const Rational x(a, b);
  const Rational y(c, d);
  expect_same(x + y, reference(a, b) + reference(c, d));
  expect_same(x - y, reference(a, b) - reference(c, d));
  RC_ASSERT((x < y) == (reference(a, b) < reference(c, d)));
}

RC_GTEST_PROP(Rational, ChangesInPlaceAreTheOperators, (const Rational& x, const Rational& y)) {
  Rational changed = x;
  RC_ASSERT((changed += y) == x + y);
  RC_ASSERT((changed -= y) == x);
  RC_ASSERT((changed *= y) == x * y);
  if (y == 0) return;
  RC_ASSERT((changed /= y) == x);
  RC_ASSERT((changed += changed) == 2 * x);
  RC_ASSERT((changed -= changed) == 0);
}

TEST(Rational, TheSimplestBetween) {
  EXPECT_EQ(simplest_between(Rational(3, 10), Rational(4, 10)), Rational(1, 3));
  EXPECT_EQ(simplest_between(Rational(1, 3), Rational(4, 10)), Rational(1, 3));
  EXPECT_EQ(simplest_between(Rational(7, 2), Rational(11, 2)), 4);
  EXPECT_EQ(simplest_between(0, Rational(1, 9)), 0);
  EXPECT_EQ(simplest_between(parse_rational("3.14159265"), parse_rational("3.14159266")), Rational(102928, 32763));
}

RC_GTEST_PROP(Rational, NoneOfASmallerDenominatorIsBetween, ()) {
  const int below = *rc::gen::inRange(1, 60);
  const Rational low(*rc::gen::inRange(0, 200), *rc::gen::inRange(1, 60));
  const Rational high = low + Rational(*rc::gen::inRange(1, 50), below);
  const Rational found = simplest_between(low, high);
  RC_ASSERT(low <= found && found <= high);
  for (int d = 1; d < found.denominator(); ++d) {
    const Rational whole = numerator(high * d) / denominator(high * d);
    RC_ASSERT(whole / d < low);
  }
}

TEST(Rational, PartsOfATemporaryAreNotItsOwn) {
  const Integer& above = numerator(Rational(Integer(1) << 100, 3));
  const Integer& below = denominator(Rational(2, Integer(3) << 100));
  EXPECT_EQ(above, Integer(1) << 100);
  EXPECT_EQ(below, Integer(3) << 99);
}

TEST(Rational, RefusesToDivideByZero) {
  EXPECT_THROW(Rational(1, 0), std::domain_error);
  EXPECT_THROW(Rational(1) / Rational(0), std::domain_error);
}

TEST(Rational, IsShownAsAFraction) {
  std::ostringstream out;
  out << Rational(-5, 4) << ' ' << Rational(6, 3);
  EXPECT_EQ(out.str(), "-5/4 2");
}

TEST(Rational, AnExponentMayHaveLeadingZerosAndBeTooLarge) {
  EXPECT_EQ(parse_rational("1e0000000000003"), Rational(1000));
  EXPECT_EQ(parse_rational("5e-007"), parse_rational("0.0000005"));
  for (const char* text : {"1e999999999", "1e-999999999", "0e99999999999999999999", "1e00000000010000"})
    expect_error<UsageError>([&] { parse_rational(text); }, "has more than 400 digits");
}

TEST(Rational, StandsForTheDecimalThatAPersonWrote) {
  EXPECT_EQ(as_written(0.1), Rational(1, 10));
  EXPECT_EQ(as_written(5e-324) > 0, true);
  EXPECT_THROW(as_written(std::nan("")), UsageError);
  EXPECT_THROW(as_written(HUGE_VAL), UsageError);
  EXPECT_EQ(to_short_text(Rational(3, 10)), "0.3");
  EXPECT_EQ(to_short_text(Rational(1, 3)), "1/3");
  EXPECT_EQ(to_short_text(Rational(2, 4)), "0.5");
  EXPECT_EQ(to_short_text(parse_rational("1e-7")), "1e-07");
  EXPECT_EQ(to_short_text(parse_rational("0.12345678901234567890")), "0.1234567890123456789");
  EXPECT_EQ(to_short_text(parse_rational("1e399")), "1" + std::string(399, '0'));  // no double is as large
}

TEST(ParseExactNumber, KeepsFractionsAndComparesTheEndsExactly) {
  EXPECT_EQ(parse_exact_number("1/3", "noise", 0, 1), Rational(1, 3));
  EXPECT_EQ(parse_exact_number("7/7", "noise", 0, 1), Rational(1));
  EXPECT_EQ(parse_exact_number("0.1", "noise", 0.1, 1), Rational(1, 10));
  EXPECT_EQ(parse_number("1/3", "noise", 0, 1), 1.0 / 3);
  EXPECT_FALSE(std::signbit(parse_number("-0", "noise", 0, 1)));
  for (const char* text :
       {"4/3", "-1/3", "1/0", "0/0", "1.00000000000000000001", "-1e-330", "1e999999999", "1/3x", "+1/3", "+1"})
    expect_error<UsageError>([&] { parse_number(text, "noise", 0, 1); },
                             std::string("noise '") + text + "': expected a number from 0 to 1");
}

TEST(ParseWholeNumber, ReadsWhateverDecimalIsWhole) {
  EXPECT_EQ(parse_whole_number("1e6", "--rounds", 1, 1'000'000), 1'000'000U);
  EXPECT_EQ(parse_whole_number("2.5e3", "--rounds", 1, 1'000'000), 2'500U);
  EXPECT_EQ(parse_whole_number("100.0", "--rounds", 1, 1'000'000), 100U);
  EXPECT_EQ(whole_number("18446744073709551615"), ~std::uint64_t{0});
  EXPECT_EQ(whole_number("0"), 0U);
  for (const char* text :
       {"18446744073709551616", "1e30", "1e999999999", "1.5", "2.55e1", "-1", "+5", "nan", "", "x"}) {
    EXPECT_EQ(whole_number(text), std::nullopt) << text;
    expect_error<UsageError>([&] { parse_whole_number(text, "--rounds", 1, 9); },
                             std::string("--rounds '") + text + "': expected a whole number from 1 to 9");
  }
  expect_error<UsageError>([&] { parse_whole_number("1e1", "--rounds", 1, 9); }, "from 1 to 9");
}

// What was printed by any program is read back to the last bit.
RC_GTEST_PROP(ParseNumber, ReadsEveryDoubleBack, (std::uint64_t bits)) {
  const auto number = std::bit_cast<double>(bits);
  RC_PRE(std::isfinite(number));
  const double largest = std::numeric_limits<double>::max();
  RC_ASSERT(parse_number(fmt::format("{}", number), "number", -largest, largest) == number);
  RC_ASSERT(parse_number(fmt::format("{:.17e}", number), "number", -largest, largest) == number);
  RC_ASSERT(to_double(as_written(number)) == number);
}

TEST(Rational, ADoubleIsShownAsTheFractionThatItWasMadeOfWhereItsDecimalIsLong) {
  for (const char* text : {"0", "0.1", "0.25", "0.05", "1e-20", "0.123456789", "1/3", "2/7", "-5/9", "1/1024",
                           "355/113", "0.1234567890123456", "123456.7890123456"}) {
    const double number = to_double(parse_rational(text));
    const std::string shown = to_short_text(number);
    EXPECT_EQ(to_double(parse_rational(shown)), number) << text;
    const bool is_long = std::string_view(text).size() >= 9;
    const std::string expected = is_long ? shown : text == std::string("1/1024") ? "0.0009765625" : text;
    EXPECT_EQ(shown, expected);
  }
  EXPECT_EQ(to_short_text(std::numeric_limits<double>::infinity()), "inf");
}

}  // namespace
}  // namespace folk
