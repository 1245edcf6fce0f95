#include <folk/analysis/thresholds/discount_set.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <memory>

#include "analysis/thresholds/polynomials.h"

namespace folk {
namespace {

using test::polynomial;
using test::product;

DiscountSet where(const Polynomial& p) {
  DiscountSet set = DiscountSet::all();
  set.cut(p, 7);
  return set;
}

TEST(DiscountSet, IsWrittenRelativeToTheUnitInterval) {
  EXPECT_EQ(to_text(DiscountSet::all()), "(0, 1)");
  EXPECT_EQ(to_text(DiscountSet::none()), "never");
  EXPECT_EQ(to_text(where(polynomial({-1, 2}))), "[1/2, 1)");
  EXPECT_EQ(to_text(where(polynomial({1, -3}))), "(0, 1/3]");
  EXPECT_EQ(to_text(where(polynomial({-1, 4, -4}))), "{1/2}");
  EXPECT_EQ(to_numbers(where(polynomial({-1, 2}))), (std::vector<std::array<double, 2>>{{0.5, 1}}));
  EXPECT_EQ(to_numbers(DiscountSet::all()), (std::vector<std::array<double, 2>>{{0, 1}}));
  EXPECT_EQ(to_exact_texts(where(polynomial({-2, 3}))), (std::vector<std::array<std::string, 2>>{{"2/3", "1"}}));
  EXPECT_TRUE(to_numbers(DiscountSet::none()).empty());
}

TEST(DiscountSet, ConstantsKeepAllOrNothing) {
  EXPECT_EQ(where(polynomial({1})), DiscountSet::all());
  EXPECT_EQ(where(Polynomial()), DiscountSet::all());
  EXPECT_EQ(where(polynomial({-1})), DiscountSet::none());
  EXPECT_EQ(where(polynomial({0, 1, -1})), DiscountSet::all());   // d (1 - d)
  EXPECT_EQ(where(polynomial({0, -1, 1})), DiscountSet::none());  // -d (1 - d)
}

TEST(DiscountSet, PartsAndPointsStayApart) {
  // -(2 d - 1)^2 (4 d - 1)(4 d - 3) (d - 2): at least 0 up to 1/4, at 1/2, from 3/4 on
  const Polynomial p = product(polynomial({1, -4, 4}), polynomial({-1, 4}), polynomial({-3, 4}));
  EXPECT_EQ(to_text(where(p)), "(0, 1/4] or {1/2} or [3/4, 1)");
  EXPECT_EQ(to_text(where(product(p, polynomial({-1})))), "[1/4, 3/4]");
  DiscountSet both = where(p);
  EXPECT_TRUE(both.intersect(where(product(p, polynomial({-1})))));
  EXPECT_EQ(to_text(both), "{1/4} or {1/2} or {3/4}");
  both.keep_interval_of(Rational(1, 2));
  EXPECT_EQ(to_text(both), "{1/2}");
  EXPECT_TRUE(both.contains(Rational(1, 2)));
  EXPECT_FALSE(both.contains(Rational(1, 3)));
}

TEST(DiscountSet, EndsTellWhatBindsThem) {
  DiscountSet set = DiscountSet::all();
  EXPECT_FALSE(set.cut(polynomial({1, 1}), 3));
  EXPECT_TRUE(set.cut(polynomial({-1, 3}), 4));
  EXPECT_TRUE(set.cut(polynomial({3, -4}), 5));
  EXPECT_FALSE(set.cut(polynomial({-1, 3}), 6));  // an end that is there already keeps its mark
  EXPECT_TRUE(set.cut(polynomial({-1, 2}), 9));
  ASSERT_EQ(to_text(set), "[1/2, 3/4]");
  EXPECT_EQ(set.renumber_constraints(), (std::vector<std::size_t>{5, 9}));
  EXPECT_EQ(set.intervals()[0].low.constraint, 1U);
  EXPECT_EQ(set.intervals()[0].high.constraint, 0U);
  EXPECT_EQ(DiscountSet::all().intervals()[0].low.constraint, DiscountSet::no_constraint);
}

TEST(DiscountSet, IrrationalEndsMeetExactly) {
  DiscountSet set = where(polynomial({-1, 0, 2}));
  EXPECT_TRUE(set.cut(product(polynomial({1, 0, -2}), polynomial({1, 1}))));
  EXPECT_EQ(to_text(set), "{root of 2 d^2 - 1 in (0.70, 0.71)}");
  EXPECT_FALSE(set.cut(product(polynomial({-1, 0, 2}), polynomial({2, 0, 0, 1}))));
  EXPECT_TRUE(set.cut(polynomial({-71, 100})));
  EXPECT_TRUE(set.empty());
  EXPECT_FALSE(set.cut(polynomial({-1})));
}

RC_GTEST_PROP(DiscountSet, HoldsExactlyWhereEveryPolynomialIsAtLeastZero, ()) {
  DiscountSet set = DiscountSet::all();
  DiscountSet together = DiscountSet::all();
  std::vector<Polynomial> cuts;
  for (int i = *rc::gen::inRange(1, 6); i > 0; --i) {
    const auto degree = static_cast<std::size_t>(*rc::gen::inRange(1, 9));
    Polynomial p = polynomial(*rc::gen::container<std::vector<int>>(degree + 1, rc::gen::inRange(-4, 5)));
    if (*rc::gen::inRange(0, 4) == 0) p = product(p, p, polynomial({*rc::gen::inRange(-1, 2)}));
    if (*rc::gen::arbitrary<bool>())
      p = product(p, polynomial({-*rc::gen::inRange(1, 8), 8}), polynomial({-*rc::gen::inRange(1, 9), 9}));
    cuts.push_back(p);
    set.cut(p);
    together.intersect(where(p));
  }
  RC_ASSERT(set == together);
  for (int i = 1; i < 60; ++i) {
    const Rational d(i, 60);
    bool inside = true;
    for (const Polynomial& p : cuts) inside = inside && p.sign_at(d) >= 0;
    RC_ASSERT(set.contains(d) == inside);
  }
  for (const auto& interval : set.intervals())
    for (const AlgebraicNumber& end : {interval.low.at, interval.high.at})
      if (end != Rational(0) && end != Rational(1)) {
        bool binds = false;
        for (const Polynomial& p : cuts) {
          const int sign = test::sign_at(end, p);
          RC_ASSERT(sign >= 0);
          binds = binds || sign == 0;
        }
        RC_ASSERT(binds);
      }
}

RC_GTEST_PROP(DiscountSet, CutsOfASmallSetAreThoseOfTheWhole, ()) {
  const auto degree = static_cast<std::size_t>(*rc::gen::inRange(0, 20));
  Polynomial p = polynomial(*rc::gen::container<std::vector<int>>(degree + 1, rc::gen::inRange(-9, 10)));
  for (const int eighth : *rc::gen::container<std::vector<int>>(3, rc::gen::inRange(0, 8)))
    p = product(p, polynomial({-eighth, 8}), polynomial({-eighth - 1, 9}));
  RC_PRE(!p.is_zero());
  const int a = *rc::gen::inRange(0, 33);
  const int b = *rc::gen::inRange(0, 33);
  DiscountSet set = where(polynomial({-std::min(a, b), 32}));
  set.cut(polynomial({std::max(a, b), -32}));
  DiscountSet expected = set;
  expected.intersect(where(p));
  set.cut(p);
  RC_ASSERT(set == expected);
  for (int i = 1; i < 96; ++i) {
    const Rational d(i, 96);
    RC_ASSERT(set.contains(d) == (3 * std::min(a, b) <= i && i <= 3 * std::max(a, b) && p.sign_at(d) >= 0));
  }
}

TEST(DiscountSet, RootsBeyondTheSetDoNotDeceive) {
  // 1/2 and 9/20 lie beyond [1/4, 5/16].
  DiscountSet set = where(polynomial({-1, 4}));
  set.cut(polynomial({5, -16}));
  set.cut(product(polynomial({-1, 2}), polynomial({-9, 20}), polynomial({-3, 10})));
  EXPECT_EQ(to_text(set), "[3/10, 5/16]");
}

/// The square root of a/b, 0 < a < b.
AlgebraicNumber square_root(int a, int b) { return {std::make_shared<const Polynomial>(polynomial({-a, 0, b})), 0, 1}; }

TEST(DiscountSet, RationalsBetweenAreFoundHoweverClose) {
  EXPECT_EQ(rational_between(Rational(0), Rational(1)), Rational(29, 64));
  const AlgebraicNumber a = square_root(1, 2);
  const AlgebraicNumber b = square_root(1'000'000'001, 2'000'000'000);
  const Rational between = rational_between(a, b);
  EXPECT_LT(a, between);
  EXPECT_GT(b, between);
}

}  // namespace
}  // namespace folk
