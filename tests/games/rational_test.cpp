#include <fmt/format.h>
#include <folk/games/rational.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "games/arbitrary.h"
#include "games/expect_error.h"

namespace folk {
namespace {

using test::expect_error;

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

}  // namespace
}  // namespace folk
