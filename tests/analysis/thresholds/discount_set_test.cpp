#include <folk/analysis/thresholds/discount_set.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace folk {
namespace {

Polynomial polynomial(std::vector<int> coefficients) {
  return Polynomial(std::vector<Integer>(coefficients.begin(), coefficients.end()));
}

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
  const Polynomial p = polynomial({1, -4, 4}) * polynomial({-1, 4}) * polynomial({-3, 4});
  EXPECT_EQ(to_text(where(p)), "(0, 1/4] or {1/2} or [3/4, 1)");
  EXPECT_EQ(to_text(where(-p)), "[1/4, 3/4]");
  DiscountSet both = where(p);
  EXPECT_TRUE(both.intersect(where(-p)));
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
  EXPECT_TRUE(set.cut(polynomial({1, 0, -2}) * polynomial({1, 1})));
  EXPECT_EQ(to_text(set), "{root of 2 d^2 - 1 in (0.70, 0.71)}");
  EXPECT_FALSE(set.cut(polynomial({-1, 0, 2}) * polynomial({2, 0, 0, 1})));
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
    if (*rc::gen::inRange(0, 4) == 0) p = p * p * polynomial({*rc::gen::inRange(-1, 2)});
    if (*rc::gen::arbitrary<bool>())
      p = p * polynomial({-*rc::gen::inRange(1, 8), 8}) * polynomial({-*rc::gen::inRange(1, 9), 9});
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
          const int sign = end.sign_of(p);
          RC_ASSERT(sign >= 0);
          binds = binds || sign == 0;
        }
        RC_ASSERT(binds);
      }
}

}  // namespace
}  // namespace folk
