#include <folk/analysis/thresholds/polynomial.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <set>

#include "analysis/thresholds/polynomials.h"

namespace folk {
namespace {

using test::polynomial;
using test::product;

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

/// Sturm's count of the distinct roots in the open interval, which p must not have at its ends.
std::size_t roots_by_sturm(const Polynomial& p, const Rational& low, const Rational& high) {
  std::vector<std::vector<Rational>> chain{test::rationals(p), {}};
  for (std::size_t i = 1; i < chain[0].size(); ++i) chain[1].push_back(i * chain[0][i]);
  while (chain.back().size() > 1) {
    auto rest = test::remainder(chain[chain.size() - 2], chain.back());
    if (rest.empty()) break;
    for (Rational& c : rest) c = -c;
    chain.push_back(std::move(rest));
  }
  const auto variations = [&](const Rational& at) {
    std::size_t count = 0;
    int last = 0;
    for (const auto& member : chain) {
      Rational sum = 0;
      for (std::size_t i = member.size(); i-- > 0;) sum = sum * at + member[i];
      if (sum.sign() != 0 && last != 0 && sum.sign() != last) ++count;
      if (sum.sign() != 0) last = sum.sign();
    }
    return count;
  };
  return variations(low) - variations(high);
}

/// Without factors d and 1 - d.
Polynomial without_outer_roots(const Polynomial& p) {
  auto rest = p.coefficients();
  while (rest.front().is_zero()) rest.erase(rest.begin());
  for (;;) {
    // p / (1 - d) has the partial sums of p's coefficients; the last of them is p(1).
    auto sums = rest;
    for (std::size_t i = 1; i < sums.size(); ++i) sums[i] += sums[i - 1];
    if (!sums.back().is_zero()) return Polynomial(rest);
    sums.pop_back();
    rest = sums;
  }
}

void check(const RootIsolation& found) {
  Rational last = 0;
  for (const auto& [low, high] : found.roots) {
    RC_ASSERT(low >= last);
    if (low == high)
      RC_ASSERT(found.polynomial.sign_at(low) == 0);
    else
      RC_ASSERT(found.polynomial.crosses(low, high));
    last = high;
  }
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
  EXPECT_EQ(polynomial({0, 0}).degree(), 0U);
}

TEST(Polynomial, OnTheUnitIntervalItsOuterFactorsGo) {
  // 6 d^3 (1 - d)^2 (2 d - 1)
  const Polynomial p =
      product(polynomial({-6, 12}), polynomial({0, 0, 0, 1}), polynomial({1, -1}), polynomial({1, -1}));
  EXPECT_EQ(isolate_roots(p).polynomial, polynomial({-1, 2}));
}

TEST(Polynomial, GreatestCommonDivisorsOfKnownPolynomials) {
  const Polynomial a = product(polynomial({-1, 2}), polynomial({1, 0, 3}));
  EXPECT_EQ(greatest_common_divisor(product(a, polynomial({4, 4})), product(a, polynomial({-6, 2}))), a);
  EXPECT_EQ(greatest_common_divisor(polynomial({2, 4}), Polynomial()), polynomial({1, 2}));
  EXPECT_EQ(greatest_common_divisor(polynomial({-2, -4}), Polynomial()), polynomial({1, 2}));
  EXPECT_EQ(greatest_common_divisor(polynomial({-1, 0, 1}), polynomial({1, 0, 1})), polynomial({1}));
  EXPECT_TRUE(greatest_common_divisor(Polynomial(), Polynomial()).is_zero());
}

TEST(Polynomial, RepeatedFactorsGo) {
  const Polynomial a = product(polynomial({-1, 2}), polynomial({1, 0, 3}));
  EXPECT_EQ(isolate_roots(product(a, a, a)).polynomial, a);
}

TEST(Polynomial, CommonDivisorsWithLargeCoefficientsAreFoundToo) {
  // Beyond 64 bits, and with a leading coefficient that vanishes modulo a prime below 2^31.
  const Polynomial large({Integer("-123456789012345678901234567890"), 1, Integer("987654321098765432109876543211")});
  EXPECT_EQ(greatest_common_divisor(product(large, polynomial({3, 1})), product(large, polynomial({5, 2, 1}))), large);
  const Integer prime = 2'147'483'647;
  EXPECT_EQ(greatest_common_divisor(product(Polynomial({1, prime}), large),
                                    product(Polynomial({1, prime}), polynomial({1, 1}))),
            Polynomial({1, prime}));
}

RC_GTEST_PROP(Polynomial, ItsSignIsThatOfItsValue, ()) {
  const Polynomial p = random_polynomial(12);
  const Rational d(*rc::gen::inRange(-30, 30), *rc::gen::inRange(1, 20));
  const Rational e(*rc::gen::inRange(-30, 30), *rc::gen::inRange(1, 20));
  RC_ASSERT(p.sign_at(d) == value(p, d).sign());
  RC_ASSERT(p.crosses(d, e) == (value(p, d) * value(p, e) < 0));
}

RC_GTEST_PROP(Polynomial, TheGreatestCommonDivisorHoldsEveryCommonFactor, ()) {
  const Polynomial common = random_polynomial(6);
  const Polynomial p = random_polynomial(6);
  const Polynomial q = random_polynomial(6);
  RC_PRE(!common.is_zero() && !p.is_zero() && !q.is_zero());
  const Polynomial divisor = greatest_common_divisor(product(p, common), product(q, common));
  RC_ASSERT(divisor == test::primitive(divisor));
  RC_ASSERT(test::divides(common, divisor));
  RC_ASSERT(test::divides(divisor, product(p, common)));
  RC_ASSERT(test::divides(divisor, product(q, common)));
  // Euclid's algorithm over the rationals ends in one of that degree.
  auto a = test::rationals(product(p, common));
  auto b = test::rationals(product(q, common));
  while (!b.empty()) a = std::exchange(b, test::remainder(a, b));
  RC_ASSERT(a.size() == divisor.degree() + 1);
}

TEST(RootIsolation, ConstantsAndOuterRootsGiveNothing) {
  EXPECT_TRUE(isolate_roots(polynomial({3})).roots.empty());
  EXPECT_TRUE(isolate_roots(polynomial({0, 0, 1, -1})).roots.empty());  // 0 and 1 themselves
  EXPECT_TRUE(isolate_roots(polynomial({6, -5, 1})).roots.empty());     // 2 and 3
  EXPECT_TRUE(isolate_roots(polynomial({1, -1, 1})).roots.empty());     // complex, two variations
}

TEST(RootIsolation, BinaryFractionsAreExact) {
  const auto found = isolate_roots(product(polynomial({-1, 2}), polynomial({-3, 4}), polynomial({-1, 3})));
  ASSERT_EQ(found.roots.size(), 3U);
  EXPECT_LT(found.roots[0].first, Rational(1, 3));
  EXPECT_GT(found.roots[0].second, Rational(1, 3));
  EXPECT_EQ(found.roots[1].first, Rational(1, 2));
  EXPECT_EQ(found.roots[1].second, Rational(1, 2));
  EXPECT_LE(found.roots[2].first, Rational(3, 4));
}

TEST(RootIsolation, TouchingRootsAreFoundOnce) {
  // (3 d - 1)^2 (5 d^2 - 1)^3
  const Polynomial p = product(polynomial({-1, 3}), polynomial({-1, 3}), polynomial({-1, 0, 5}), polynomial({-1, 0, 5}),
                               polynomial({-1, 0, 5}));
  EXPECT_EQ(isolate_roots(p).roots.size(), 2U);
}

TEST(RootIsolation, RootsThatAreCloseAreToldApart) {
  // 1/3 and 1000/3001
  EXPECT_EQ(isolate_roots(product(polynomial({-1, 3}), polynomial({-1000, 3001}))).roots.size(), 2U);
}

TEST(RootIsolation, LargeDegreesAreSeenThrough) {
  // A polynomial of positive coefficients has no positive root and hides (3 d - 1)(7 d - 5)(2 d - 1)^2.
  std::vector<int> positive;
  for (int i = 0; i <= 146; ++i) positive.push_back(1 + (i * i * 7 + i) % 11);
  const Polynomial p = product(polynomial(positive), polynomial({-1, 3}), polynomial({-5, 7}));
  EXPECT_EQ(isolate_roots(product(p, polynomial({-1, 2}), polynomial({-1, 2}))).roots.size(), 3U);
  EXPECT_EQ(isolate_roots(product(p, p)).roots.size(), 2U);
}

RC_GTEST_PROP(RootIsolation, CountsAsSturmDoes, ()) {
  const auto degree = static_cast<std::size_t>(*rc::gen::inRange(0, 20));
  const Polynomial p = polynomial(*rc::gen::container<std::vector<int>>(degree + 1, rc::gen::inRange(-9, 10)));
  RC_PRE(!p.is_zero());
  const RootIsolation found = isolate_roots(p);
  check(found);
  RC_ASSERT(found.roots.size() == roots_by_sturm(without_outer_roots(p), 0, 1));
}

RC_GTEST_PROP(RootIsolation, FindsRationalRootsWithTheirNeighbours, ()) {
  Polynomial p({1});
  std::set<Rational> roots;
  for (int i = *rc::gen::inRange(1, 6); i > 0; --i) {
    const int below = *rc::gen::inRange(2, 20);
    const int above = *rc::gen::inRange(1, below);
    roots.insert(Rational(above, below));
    for (int times = *rc::gen::inRange(1, 4); times > 0; --times) p = product(p, polynomial({-above, below}));
  }
  const RootIsolation found = isolate_roots(product(p, polynomial({2, -3, 4})));
  check(found);
  RC_ASSERT(found.roots.size() == roots.size());
  auto root = roots.begin();
  for (const auto& [low, high] : found.roots) {
    const bool holds = low == high ? low == *root : low < *root && *root < high;
    RC_ASSERT(holds);
    ++root;
  }
}

}  // namespace
}  // namespace folk
