#include <folk/analysis/thresholds/polynomial.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace folk {
namespace {

Polynomial polynomial(std::vector<int> coefficients) {
  return Polynomial(std::vector<Integer>(coefficients.begin(), coefficients.end()));
}

Polynomial random_polynomial(int most_degree) {
  const auto degree = static_cast<std::size_t>(*rc::gen::inRange(0, most_degree + 1));
  return polynomial(*rc::gen::container<std::vector<int>>(degree + 1, rc::gen::inRange(-9, 10)));
}

Rational value(const Polynomial& p, const Rational& d) {
  Rational sum = 0;
  Rational power = 1;
  for (const Integer& c : p.coefficients()) {
    sum += c * power;
    power *= d;
  }
  return sum;
}

TEST(Polynomial, WritesItselfAsPeopleDo) {
  EXPECT_EQ(to_text(polynomial({-1, 1, 3})), "3 d^2 + d - 1");
  EXPECT_EQ(to_text(polynomial({0, -1, 0, -2})), "-2 d^3 - d");
  EXPECT_EQ(to_text(polynomial({7, 0})), "7");
  EXPECT_EQ(to_text(Polynomial()), "0");
}

TEST(Polynomial, DropsZerosAtTheEnd) {
  EXPECT_EQ(polynomial({1, 2, 0, 0}).degree(), 1U);
  EXPECT_TRUE(polynomial({0, 0}).is_zero());
  EXPECT_TRUE((polynomial({1, 2}) - polynomial({1, 2})).is_zero());
}

TEST(Polynomial, OnTheUnitIntervalItsOuterFactorsGo) {
  // 6 d^3 (1 - d)^2 (2 d - 1)
  const Polynomial p = polynomial({-6, 12}).times_power(3).times_one_minus_power(1).times_one_minus_power(1);
  EXPECT_EQ(p.reduced_on_unit_interval(), polynomial({-1, 2}));
  EXPECT_TRUE(Polynomial().reduced_on_unit_interval().is_zero());
}

TEST(Polynomial, GreatestCommonDivisorsOfKnownPolynomials) {
  const Polynomial a = polynomial({-1, 2}) * polynomial({1, 0, 3});
  EXPECT_EQ(greatest_common_divisor(a * polynomial({4, 4}), -a * polynomial({6, -2})), a);
  EXPECT_EQ(greatest_common_divisor(polynomial({2, 4}), Polynomial()), polynomial({1, 2}));
  EXPECT_EQ(greatest_common_divisor(polynomial({-1, 0, 1}), polynomial({1, 0, 1})), polynomial({1}));
  EXPECT_EQ(squarefree_part(a * a * a), a);
}

TEST(Polynomial, CommonDivisorsWithLargeCoefficientsAreFoundToo) {
  // Beyond the prime below 2^31 whose image is tried first.
  const Polynomial large({Integer("-123456789012345678901234567890"), 1, Integer("987654321098765432109876543211")});
  EXPECT_EQ(greatest_common_divisor(large * polynomial({3, 1}), large * polynomial({5, 2, 1})), large);
  const Integer prime = 2'147'483'647;
  EXPECT_EQ(greatest_common_divisor(Polynomial({1, prime}) * large, Polynomial({1, prime}) * polynomial({1, 1})),
            Polynomial({1, prime}));
}

RC_GTEST_PROP(Polynomial, ArithmeticIsThatOfItsValues, ()) {
  const Polynomial p = random_polynomial(12);
  const Polynomial q = random_polynomial(12);
  const Rational d(*rc::gen::inRange(-30, 30), *rc::gen::inRange(1, 20));
  const auto k = *rc::gen::inRange<std::size_t>(1, 6);
  RC_ASSERT(value(p + q, d) == value(p, d) + value(q, d));
  RC_ASSERT(value(p - q, d) == value(p, d) - value(q, d));
  RC_ASSERT(value(p * q, d) == value(p, d) * value(q, d));
  Rational power = 1;
  for (std::size_t i = 0; i < k; ++i) power *= d;
  RC_ASSERT(value(p.times_power(k), d) == value(p, d) * power);
  RC_ASSERT(value(p.times_one_minus_power(k), d) == value(p, d) * (1 - power));
  RC_ASSERT(p.sign_at(d) == value(p, d).sign());
}

RC_GTEST_PROP(Polynomial, TheGreatestCommonDivisorHoldsEveryCommonFactor, ()) {
  const Polynomial common = random_polynomial(6);
  const Polynomial p = random_polynomial(6);
  const Polynomial q = random_polynomial(6);
  RC_PRE(!common.is_zero() && !p.is_zero() && !q.is_zero());
  const Polynomial divisor = greatest_common_divisor(p * common, q * common);
  const Polynomial primitive = common.primitive_part();
  RC_ASSERT(exact_quotient(divisor, primitive) * primitive == divisor);
  RC_ASSERT(exact_quotient(p * common, divisor) * divisor == p * common);
  RC_ASSERT(exact_quotient(q * common, divisor) * divisor == q * common);
  RC_ASSERT(greatest_common_divisor(exact_quotient(p * common, divisor), exact_quotient(q * common, divisor)) ==
            polynomial({1}));
}

}  // namespace
}  // namespace folk
