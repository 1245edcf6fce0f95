#include <folk/games/criterion.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "games/expect_error.h"

namespace folk {
namespace {

using test::expect_error;

TEST(Criterion, PrintsItself) {
  EXPECT_EQ(Criterion::finite(100).to_string(), "finite:100");
  EXPECT_EQ(Criterion::discounted(0.9).to_string(), "discounted:0.9");
  EXPECT_EQ(Criterion::mean().to_string(), "mean");
  EXPECT_EQ(Criterion::ending(0.01).to_string(), "ending:0.01");
}

TEST(Criterion, KnowsItsWeights) {
  EXPECT_EQ(Criterion::finite(7).rounds(), 7U);
  EXPECT_EQ(Criterion::finite(7).total_weight(), 7);
  EXPECT_EQ(Criterion::finite(7).continuation(), 1);
  EXPECT_EQ(Criterion::discounted(0.75).continuation(), 0.75);
  EXPECT_EQ(Criterion::discounted(0.75).total_weight(), 1);
  EXPECT_EQ(Criterion::ending(0.25).continuation(), 0.75);
  EXPECT_EQ(Criterion::ending(0.25).total_weight(), 4);
  EXPECT_EQ(Criterion::ending(1).total_weight(), 1);
  EXPECT_EQ(Criterion::mean().continuation(), 1);
  EXPECT_EQ(Criterion::mean().total_weight(), 1);
  EXPECT_TRUE(Criterion::finite(7).is_finite());
  EXPECT_FALSE(Criterion::mean().is_finite());
  EXPECT_THROW(Criterion::mean().rounds(), std::logic_error);
}

TEST(Criterion, KnowsTheRoundsUntilLittleIsLeft) {
  EXPECT_EQ(Criterion::discounted(0.5).rounds_until_left(0.125), 3);
  EXPECT_EQ(Criterion::discounted(0.5).rounds_until_left(0.12), 4);
  EXPECT_EQ(Criterion::discounted(0.5).rounds_until_left(0.9), 1);
  EXPECT_EQ(Criterion::ending(0.75).rounds_until_left(0.0625), 2);
  EXPECT_EQ(Criterion::ending(1).rounds_until_left(1e-17), 1);
  EXPECT_EQ(Criterion::finite(7).rounds_until_left(0.5), 7);
  EXPECT_TRUE(std::isinf(Criterion::mean().rounds_until_left(0.5)));
  // 1 - 1e-15 is no double: log(1 - p) alone would be wrong in the fourth digit.
  EXPECT_NEAR(Criterion::ending(1e-15).rounds_until_left(0.5) / (std::log(2) / 1e-15), 1, 1e-9);
  EXPECT_EQ(Criterion::discounted(1e-15).rounds_until_left(0.9999e-30), 3) << "log1p(-stopping) alone says 2";
}

RC_GTEST_PROP(CriterionProperty, AfterTheRoundsUntilLittleIsLeftItIsAndNotARoundBefore, ()) {
  const double stop = *rc::gen::inRange(1, 1000) / 1000.0;
  const double share = std::pow(10.0, -*rc::gen::inRange(1, 180) / 10.0);
  const auto criterion = *rc::gen::element(Criterion::discounted(1 - stop), Criterion::ending(stop));
  const double rounds = criterion.rounds_until_left(share);
  RC_ASSERT(rounds >= 1 && rounds == std::floor(rounds));
  RC_ASSERT(std::pow(criterion.continuation(), rounds) <= share * (1 + 1e-9));
  RC_ASSERT(rounds == 1 || std::pow(criterion.continuation(), rounds - 1) >= share * (1 - 1e-9));
}

TEST(Criterion, TakesTheEndsOfItsRanges) {
  for (const char* text : {"finite:1", "finite:1000000000000000", "discounted:5e-324", "discounted:0.9999999999999999",
                           "ending:1", "ending:1e-15"})
    EXPECT_EQ(Criterion::parse(text).to_string(), text);
}

TEST(Criterion, KeepsWhatWasWritten) {
  EXPECT_EQ(Criterion::parse("discounted:0.9").exact_continuation(), Rational(9, 10));
  EXPECT_EQ(Criterion::discounted(0.9), Criterion::parse("discounted:9/10"));
  EXPECT_EQ(Criterion::parse("discounted:2/3").exact_continuation(), Rational(2, 3));
  EXPECT_EQ(Criterion::parse("discounted:4/6").to_string(), "discounted:2/3");
  EXPECT_EQ(Criterion::parse("discounted:1/2").to_string(), "discounted:0.5");
  EXPECT_DOUBLE_EQ(Criterion::parse("discounted:2/3").continuation(), 2.0 / 3);
  EXPECT_EQ(Criterion::parse("ending:1/3").exact_continuation(), Rational(2, 3));
  EXPECT_EQ(Criterion::parse("ending:1e-15").exact_continuation(), 1 - parse_rational("1e-15"));
  EXPECT_EQ(Criterion::parse("ending:1").exact_continuation(), 0);
  EXPECT_EQ(Criterion::mean().exact_continuation(), 1);
  // More digits than a double holds.
  const auto fine = Criterion::parse("discounted:0.1234567890123456789");
  EXPECT_EQ(fine.exact_continuation(), parse_rational("0.1234567890123456789"));
  EXPECT_EQ(Criterion::parse(fine.to_string()), fine);
  for (const char* text : {"discounted:3/2", "discounted:-1/2", "discounted:0/5", "discounted:1/1", "ending:3/2",
                           "ending:0/1", "ending:1/2000000000000000", "discounted:0.99999999999999999999"})
    expect_error<UsageError>([&] { Criterion::parse(text); }, "expected");
  for (const char* text : {"discounted:1/0", "discounted:1/", "discounted:/2", "ending:1/x", "ending:0.5/2"})
    EXPECT_THROW(Criterion::parse(text), UsageError) << text;
}

RC_GTEST_PROP(Criterion, FractionsAreReadBack, ()) {
  const auto below = *rc::gen::inRange<std::int64_t>(2, 1'000'000);
  const auto above = *rc::gen::inRange<std::int64_t>(1, below);
  for (const Criterion& criterion :
       {Criterion::discounted(Rational(above, below)), Criterion::ending(Rational(above, below))})
    RC_ASSERT(Criterion::parse(criterion.to_string()) == criterion);
}

TEST(Criterion, RefusesWrongValues) {
  for (const char* text : {"",
                           ":",
                           "mean:",
                           "mean:1",
                           "Mean",
                           "means",
                           " mean",
                           "mean ",
                           "finite",
                           "finite:",
                           "finite:0",
                           "finite:-1",
                           "finite:1e30",
                           "finite:1.5",
                           "finite:+5",
                           "finite: 5",
                           "finite:5 ",
                           "finite:nan",
                           "finite:inf",
                           "finite:0x10",
                           "finite:1000000000000001",
                           "finite:18446744073709551617",
                           "finite:99999999999999999999999999",
                           "discounted",
                           "discounted:",
                           "discounted:0",
                           "discounted:-0",
                           "discounted:1",
                           "discounted:1.5",
                           "discounted:-1",
                           "discounted:nan",
                           "discounted:NaN",
                           "discounted:inf",
                           "discounted:-inf",
                           "discounted:1e30",
                           "discounted:1e-400",
                           "discounted:0.5x",
                           "discounted:0,5",
                           "ending:0",
                           "ending:-0.1",
                           "ending:1.5",
                           "ending:nan",
                           "ending:inf",
                           "ending:1e30",
                           "ending:1e-16",
                           "ending:1e-400",
                           "ending:",
                           "ending:0.1:0.2",
                           "bogus:1",
                           "\n"})
    expect_error<UsageError>([&] { Criterion::parse(text); }, "expected");
}

TEST(Criterion, RefusesWrongNumbers) {
  const double nan = std::nan("");
  const double infinite = HUGE_VAL;
  EXPECT_THROW(Criterion::finite(0), UsageError);
  EXPECT_THROW(Criterion::finite(Criterion::most_rounds + 1), UsageError);
  for (const double wrong : {nan, infinite, -infinite, 0.0, 1.0, 1.5, -1.0, 1e30})
    EXPECT_THROW(Criterion::discounted(wrong), UsageError);
  for (const double wrong : {nan, infinite, -infinite, 0.0, 1.5, -1.0, 1e30, 1e-16})
    EXPECT_THROW(Criterion::ending(wrong), UsageError);
}

TEST(ParseRounds, RefusesWhatIsNoNumberOfRounds) {
  EXPECT_EQ(parse_rounds("1000000000000"), 1'000'000'000'000U);
  EXPECT_EQ(Criterion::parse("finite:1e3"), Criterion::finite(1000));
  for (const char* text : {"", "0", "-1", "1e30", "1.5", "nan", "inf", "5x", " 5"})
    expect_error<UsageError>([&] { parse_rounds(text); }, "expected a whole number from 1 to 1000000000000000");
}

TEST(ParseNumber, NamesWhatItRead) {
  EXPECT_EQ(parse_number("0.05", "noise", 0, 1), 0.05);
  for (const char* text : {"", "1.5", "-0.1", "nan", "inf", "1e30", "0.1 ", "x"})
    expect_error<UsageError>([&] { parse_number(text, "noise", 0, 1); },
                             std::string("noise '") + text + "': expected a number from 0 to 1");
}

RC_GTEST_PROP(Criterion, EveryKindIsReadBack, ()) {
  // Odd numerators over 2^53 - 1: any double of (0, 1) can come up, 1 itself cannot.
  const double number = static_cast<double>(*rc::gen::inRange<std::int64_t>(10, (1LL << 53) - 1)) * 0x1p-53;
  const auto rounds = *rc::gen::inRange<std::uint64_t>(1, Criterion::most_rounds);
  for (const Criterion& criterion :
       {Criterion::finite(rounds), Criterion::discounted(number), Criterion::mean(), Criterion::ending(number)})
    RC_ASSERT(Criterion::parse(criterion.to_string()) == criterion);
}

}  // namespace
}  // namespace folk
