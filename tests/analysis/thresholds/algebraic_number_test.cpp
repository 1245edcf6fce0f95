#include <folk/analysis/thresholds/discount_set.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <stdexcept>

#include "analysis/thresholds/polynomials.h"

namespace folk {
namespace {

using test::product;

std::shared_ptr<const Polynomial> shared(const std::vector<int>& coefficients) {
  return std::make_shared<const Polynomial>(test::polynomial(coefficients));
}

AlgebraicNumber first_root(const Polynomial& p) { return roots_of(p).at(0); }

/// The square root of a/b, 0 < a < b.
AlgebraicNumber root_of(int a, int b) { return {shared({-a, 0, b}), 0, 1}; }

TEST(AlgebraicNumber, RationalRootsAreRecognised) {
  // (3 d - 2)(d + 5)
  const AlgebraicNumber two_thirds(shared({-10, 13, 3}), Rational(1, 8), 1);
  EXPECT_TRUE(two_thirds.is_rational());
  EXPECT_EQ(to_text(two_thirds), "2/3");
  // (1009 d - 997)(d^2 + 1)
  EXPECT_EQ(to_text(AlgebraicNumber(shared({-997, 1009, -997, 1009}), 0, 1)), "997/1009");
  EXPECT_EQ(to_text(AlgebraicNumber(Rational(1))), "1");
  EXPECT_EQ(to_text(AlgebraicNumber(Rational(1, 2))), "1/2");
}

TEST(AlgebraicNumber, IrrationalRootsAreWrittenByTheirPolynomial) {
  EXPECT_EQ(to_text(AlgebraicNumber(shared({-1, 1, 3}), 0, 1)), "root of 3 d^2 + d - 1 in (0.43, 0.44)");
  // times (d^2 + d + 1)(d + 1) and a sign
  const Polynomial p = product(*shared({1, -1, -3}), *shared({1, 1, 1}), *shared({1, 1}));
  EXPECT_EQ(to_text(AlgebraicNumber(std::make_shared<const Polynomial>(p), 0, 1)),
            "root of 3 d^2 + d - 1 in (0.43, 0.44)");
  // (2 d - 1)^2 = 3 / 100000
  EXPECT_EQ(to_text(AlgebraicNumber(shared({99997, -400000, 400000}), Rational(1, 4), Rational(1, 2))),
            "root of 400000 d^2 - 400000 d + 99997 in (0.49, 0.50)");
  // (100 d - 45)^2 = 3 / 1000: both within (0.449, 0.451)
  EXPECT_EQ(to_text(AlgebraicNumber(shared({2024997, -9000000, 10000000}), Rational(1, 4), Rational(45, 100))),
            "root of 10000000 d^2 - 9000000 d + 2024997 in (0.44, 0.45)");
  // (200 d - 91)^2 = 3 / 1000: both within (0.4547, 0.4553)
  EXPECT_EQ(to_text(AlgebraicNumber(shared({8280997, -36400000, 40000000}), Rational(1, 4), Rational(455, 1000))),
            "root of 40000000 d^2 - 36400000 d + 8280997 in (0.454, 0.455)");
}

TEST(AlgebraicNumber, AnIntervalWithoutItsRootIsRefused) {
  EXPECT_THROW(AlgebraicNumber(shared({1, 0, 1}), 0, 1), std::logic_error);
}

TEST(AlgebraicNumber, EqualNumbersOfDifferentPolynomialsAreEqual) {
  const AlgebraicNumber a(shared({-1, 0, 2}), 0, 1);
  const auto p = std::make_shared<const Polynomial>(product(*shared({-1, 0, 2}), *shared({-1, 3, 1})));
  const AlgebraicNumber b(p, Rational(1, 2), 1);
  EXPECT_EQ(a, b);
  EXPECT_LT(AlgebraicNumber(p, 0, Rational(1, 2)), a);
  EXPECT_EQ(test::sign_at(a, *p), 0);
  EXPECT_EQ(test::sign_at(a, *shared({-7, 10})), 1);
  EXPECT_EQ(test::sign_at(a, *shared({-8, 10})), -1);
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

TEST(MinimalPolynomial, OtherFactorsAreLeftOut) {
  const Polynomial minimal = test::polynomial({-1, 0, 3});
  EXPECT_EQ(first_root(product(minimal, test::polynomial({1, 0, -1, 1}))).minimal_polynomial(), minimal);
  EXPECT_EQ(first_root(product(minimal, minimal, test::polynomial({-5, 1, 1, 3}))).minimal_polynomial(), minimal);
  EXPECT_EQ(first_root(product(minimal, test::polynomial({-1}))).minimal_polynomial(), minimal);
}

TEST(MinimalPolynomial, HighDegreesLoseTheRootsOfUnity) {
  // d^17 + d - 1 is (d^2 - d + 1) times an irreducible one of degree 15
  std::vector<int> coefficients(18);
  coefficients[0] = -1;
  coefficients[1] = coefficients[17] = 1;
  EXPECT_EQ(
      first_root(product(test::polynomial(coefficients), test::polynomial({1, 1, 1}))).minimal_polynomial().degree(),
      15U);
}

TEST(MinimalPolynomial, OfHighDegreesInProducts) {
  for (const std::size_t degree : {11U, 15U, 29U}) {
    std::vector<int> coefficients(degree + 1);  // 3 d^n + 2 d - 2: irreducible (Eisenstein at 2), one root
    coefficients[0] = -2;
    coefficients[1] = 2;
    coefficients[degree] = 3;
    const Polynomial minimal = test::polynomial(coefficients);
    const AlgebraicNumber root = first_root(product(minimal, test::polynomial({5, 3, 0, 0, 1})));
    EXPECT_EQ(root.minimal_polynomial(), minimal);
    EXPECT_EQ(to_text(root).rfind("root of " + to_text(minimal) + " in (0.", 0), 0U) << to_text(root);
  }
}

RC_GTEST_PROP(MinimalPolynomial, OfARandomIrreducibleOneTimesAnother, ()) {
  // Eisenstein at 2: all but the leading coefficient even, the constant not by 4.
  const auto degree = static_cast<std::size_t>(*rc::gen::inRange(2, 7));
  std::vector<int> coefficients(degree + 1);
  for (int& c : coefficients) c = 2 * *rc::gen::inRange(-3, 4);
  coefficients.front() = -2;
  coefficients.back() = 2 * *rc::gen::inRange(5, 20) + 1;  // a root in (0, 1): p(0) < 0 < p(1)
  const Polynomial irreducible = test::polynomial(coefficients);
  RC_PRE(irreducible.sign_at(1) > 0);
  RC_PRE(roots_of(irreducible).size() == 1U);
  const Polynomial p = product(irreducible, test::polynomial({*rc::gen::inRange(1, 9), *rc::gen::inRange(1, 9), 1, 4}));
  RC_ASSERT(first_root(p).minimal_polynomial() == test::primitive(irreducible));
}

}  // namespace
}  // namespace folk
