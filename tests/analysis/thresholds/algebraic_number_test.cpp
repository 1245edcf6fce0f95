#include <folk/analysis/thresholds/algebraic_number.h>
#include <folk/analysis/thresholds/minimal_polynomial.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <stdexcept>

namespace folk {
namespace {

std::shared_ptr<const Polynomial> polynomial(std::vector<int> coefficients) {
  return std::make_shared<const Polynomial>(std::vector<Integer>(coefficients.begin(), coefficients.end()));
}

/// The square root of a/b, 0 < a < b.
AlgebraicNumber root_of(int a, int b) { return {polynomial({-a, 0, b}), 0, 1}; }

TEST(AlgebraicNumber, RationalRootsAreRecognised) {
  // (3 d - 2)(d + 5)
  const AlgebraicNumber two_thirds(polynomial({-10, 13, 3}), Rational(1, 8), 1);
  EXPECT_TRUE(two_thirds.is_rational());
  EXPECT_EQ(to_text(two_thirds), "2/3");
  // (1009 d - 997)(d^2 + 1)
  EXPECT_EQ(to_text(AlgebraicNumber(polynomial({-997, 1009, -997, 1009}), 0, 1)), "997/1009");
  EXPECT_EQ(to_text(AlgebraicNumber(Rational(1))), "1");
  EXPECT_EQ(to_text(AlgebraicNumber(Rational(1, 2))), "1/2");
}

TEST(AlgebraicNumber, IrrationalRootsAreWrittenByTheirPolynomial) {
  EXPECT_EQ(to_text(AlgebraicNumber(polynomial({-1, 1, 3}), 0, 1)), "root of 3 d^2 + d - 1 in (0.43, 0.44)");
  // times (d^2 + d + 1)(d + 1) and a sign
  const Polynomial p = *polynomial({1, -1, -3}) * *polynomial({1, 1, 1}) * *polynomial({1, 1});
  EXPECT_EQ(to_text(AlgebraicNumber(std::make_shared<const Polynomial>(p), 0, 1)),
            "root of 3 d^2 + d - 1 in (0.43, 0.44)");
  // (2 d - 1)^2 = 3 / 100000
  EXPECT_EQ(to_text(AlgebraicNumber(polynomial({99997, -400000, 400000}), Rational(1, 4), Rational(1, 2))),
            "root of 400000 d^2 - 400000 d + 99997 in (0.49, 0.50)");
  // (100 d - 45)^2 = 3 / 1000: both within (0.449, 0.451)
  EXPECT_EQ(to_text(AlgebraicNumber(polynomial({2024997, -9000000, 10000000}), Rational(1, 4), Rational(45, 100))),
            "root of 10000000 d^2 - 9000000 d + 2024997 in (0.44, 0.45)");
  // (200 d - 91)^2 = 3 / 1000: both within (0.4547, 0.4553)
  EXPECT_EQ(to_text(AlgebraicNumber(polynomial({8280997, -36400000, 40000000}), Rational(1, 4), Rational(455, 1000))),
            "root of 40000000 d^2 - 36400000 d + 8280997 in (0.454, 0.455)");
}

TEST(AlgebraicNumber, AnIntervalWithoutItsRootIsRefused) {
  EXPECT_THROW(AlgebraicNumber(polynomial({1, 0, 1}), 0, 1), std::logic_error);
}

TEST(AlgebraicNumber, EqualNumbersOfDifferentPolynomialsAreEqual) {
  const AlgebraicNumber a(polynomial({-1, 0, 2}), 0, 1);
  const auto p = std::make_shared<const Polynomial>(*polynomial({-1, 0, 2}) * *polynomial({-1, 3, 1}));
  const AlgebraicNumber b(p, Rational(1, 2), 1);
  EXPECT_EQ(a, b);
  EXPECT_LT(AlgebraicNumber(p, 0, Rational(1, 2)), a);
  EXPECT_EQ(a.sign_of(*p), 0);
  EXPECT_EQ(a.sign_of(*polynomial({-7, 10})), 1);
  EXPECT_EQ(a.sign_of(*polynomial({-8, 10})), -1);
}

TEST(AlgebraicNumber, RationalsBetweenAreFoundHoweverClose) {
  EXPECT_EQ(rational_between(Rational(0), Rational(1)), Rational(29, 64));
  const AlgebraicNumber a = root_of(1, 2);
  const AlgebraicNumber b = root_of(1'000'000'001, 2'000'000'000);
  const Rational between = rational_between(a, b);
  EXPECT_LT(a, between);
  EXPECT_GT(b, between);
}

RC_GTEST_PROP(AlgebraicNumber, ComparesAsItsSquare, ()) {
  const int b = *rc::gen::inRange(2, 40);
  const int a = *rc::gen::inRange(1, b);
  const int d = *rc::gen::inRange(2, 40);
  const int c = *rc::gen::inRange(1, d);
  const AlgebraicNumber x = root_of(a, b);
  const AlgebraicNumber y = root_of(c, d);
  RC_ASSERT((x < y) == (a * d < b * c));
  RC_ASSERT((x == y) == (a * d == b * c));
  RC_ASSERT((x > Rational(c, d)) == (a * d * d > b * c * c));
  RC_ASSERT((x == Rational(c, d)) == (a * d * d == b * c * c));
  RC_ASSERT(std::abs(x.nearest() - std::sqrt(static_cast<double>(a) / b)) < 1e-15);
}

}  // namespace
}  // namespace folk
