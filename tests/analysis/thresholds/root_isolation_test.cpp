#include <folk/analysis/thresholds/root_isolation.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <set>

namespace folk {
namespace {

Polynomial polynomial(std::vector<int> coefficients) {
  return Polynomial(std::vector<Integer>(coefficients.begin(), coefficients.end()));
}

/// Sturm's count of the distinct roots in the open interval, which p must not have at its ends.
std::size_t roots_by_sturm(const Polynomial& p, const Rational& low, const Rational& high) {
  std::vector<std::vector<Rational>> chain(2);
  for (const Integer& c : p.coefficients()) chain[0].emplace_back(c);
  const Polynomial derivative = p.derivative();
  for (const Integer& c : derivative.coefficients()) chain[1].emplace_back(c);
  while (chain.back().size() > 1) {
    auto rest = chain[chain.size() - 2];
    const auto& by = chain.back();
    while (rest.size() >= by.size()) {
      const Rational factor = rest.back() / by.back();
      for (std::size_t i = 0; i < by.size(); ++i) rest[rest.size() - by.size() + i] -= factor * by[i];
      rest.pop_back();
      while (!rest.empty() && rest.back() == 0) rest.pop_back();
    }
    if (rest.empty()) break;
    for (Rational& c : rest) c = -c;
    chain.push_back(rest);
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

void check(const RootIsolation& found) {
  Rational last = 0;
  for (const RootInterval& root : found.roots) {
    RC_ASSERT(root.low >= last);
    if (root.low == root.high)
      RC_ASSERT(found.polynomial.sign_at(root.low) == 0);
    else
      RC_ASSERT(found.polynomial.sign_at(root.low) * found.polynomial.sign_at(root.high) < 0);
    last = root.high;
  }
}

TEST(RootIsolation, ConstantsAndOuterRootsGiveNothing) {
  EXPECT_TRUE(isolate_roots(polynomial({3})).roots.empty());
  EXPECT_TRUE(isolate_roots(polynomial({0, 0, 1, -1})).roots.empty());  // 0 and 1 themselves
  EXPECT_TRUE(isolate_roots(polynomial({6, -5, 1})).roots.empty());     // 2 and 3
  EXPECT_TRUE(isolate_roots(polynomial({1, -1, 1})).roots.empty());     // complex, two variations
}

TEST(RootIsolation, BinaryFractionsAreExact) {
  const auto found = isolate_roots(polynomial({-1, 2}) * polynomial({-3, 4}) * polynomial({-1, 3}));
  ASSERT_EQ(found.roots.size(), 3U);
  EXPECT_LT(found.roots[0].low, Rational(1, 3));
  EXPECT_GT(found.roots[0].high, Rational(1, 3));
  EXPECT_EQ(found.roots[1].low, Rational(1, 2));
  EXPECT_EQ(found.roots[1].high, Rational(1, 2));
  EXPECT_LE(found.roots[2].low, Rational(3, 4));
}

TEST(RootIsolation, TouchingRootsAreFoundOnce) {
  // (3 d - 1)^2 (5 d^2 - 1)^3
  const Polynomial p = polynomial({-1, 3}) * polynomial({-1, 3}) * polynomial({-1, 0, 5}) * polynomial({-1, 0, 5}) *
                       polynomial({-1, 0, 5});
  EXPECT_EQ(isolate_roots(p).roots.size(), 2U);
}

TEST(RootIsolation, RootsThatAreCloseAreToldApart) {
  // 1/3 and 1000/3001
  EXPECT_EQ(isolate_roots(polynomial({-1, 3}) * polynomial({-1000, 3001})).roots.size(), 2U);
}

TEST(RootIsolation, LargeDegreesAreSeenThrough) {
  // A polynomial of positive coefficients has no positive root and hides (3 d - 1)(7 d - 5)(2 d - 1)^2.
  std::vector<int> positive;
  for (int i = 0; i <= 146; ++i) positive.push_back(1 + (i * i * 7 + i) % 11);
  const Polynomial p = polynomial(positive) * polynomial({-1, 3}) * polynomial({-5, 7});
  EXPECT_EQ(isolate_roots(p * polynomial({-1, 2}) * polynomial({-1, 2})).roots.size(), 3U);
  EXPECT_EQ(isolate_roots(p * p).roots.size(), 2U);
}

RC_GTEST_PROP(RootIsolation, CountsAsSturmDoes, ()) {
  const auto degree = static_cast<std::size_t>(*rc::gen::inRange(0, 20));
  const Polynomial p = polynomial(*rc::gen::container<std::vector<int>>(degree + 1, rc::gen::inRange(-9, 10)));
  RC_PRE(!p.is_zero());
  const RootIsolation found = isolate_roots(p);
  check(found);
  RC_ASSERT(found.roots.size() == roots_by_sturm(p.reduced_on_unit_interval(), 0, 1));
}

RC_GTEST_PROP(RootIsolation, FindsRationalRootsWithTheirNeighbours, ()) {
  Polynomial p({1});
  std::set<Rational> roots;
  for (int i = *rc::gen::inRange(1, 6); i > 0; --i) {
    const int below = *rc::gen::inRange(2, 20);
    const int above = *rc::gen::inRange(1, below);
    roots.insert(Rational(above, below));
    for (int times = *rc::gen::inRange(1, 4); times > 0; --times) p = p * polynomial({-above, below});
  }
  const RootIsolation found = isolate_roots(p * polynomial({2, -3, 4}));
  check(found);
  RC_ASSERT(found.roots.size() == roots.size());
  auto root = roots.begin();
  for (const RootInterval& interval : found.roots) {
    const bool exact = interval.low == interval.high;
    const bool holds = exact ? interval.low == *root : interval.low < *root && *root < interval.high;
    RC_ASSERT(holds);
    ++root;
  }
}

RC_GTEST_PROP(RootIsolation, AStretchHasTheRootsOfTheWhole, ()) {
  const auto degree = static_cast<std::size_t>(*rc::gen::inRange(0, 20));
  Polynomial p = polynomial(*rc::gen::container<std::vector<int>>(degree + 1, rc::gen::inRange(-9, 10)));
  for (const int eighth : *rc::gen::container<std::vector<int>>(3, rc::gen::inRange(0, 8)))
    p = p * polynomial({-eighth, 8}) * polynomial({-eighth - 1, 9});
  RC_PRE(!p.is_zero());
  const int a = *rc::gen::inRange(0, 33);
  const int b = *rc::gen::inRange(0, 33);
  const Rational low(std::min(a, b), 32);
  const Rational high(std::max(a, b), 32);
  const RootIsolation found = isolate_roots(p, low, high);
  check(found);
  RC_ASSERT(found.low <= low && found.high >= high);
  std::vector<RootInterval> expected = isolate_roots(p).roots;
  std::erase_if(expected, [&](const RootInterval& root) { return root.low < found.low || root.high > found.high; });
  RC_ASSERT(found.roots.size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    RC_ASSERT(found.roots[i].low < expected[i].high || found.roots[i].low == expected[i].low);
}

TEST(RootIsolation, RootsAtMiddlesBeyondTheStretchAreNotPassedOn) {
  // 1/2 is met first, and 9/20 between it and the stretch is not: without 9/20 the signs beside 1/2 would deceive.
  const RootIsolation found =
      isolate_roots(polynomial({-1, 2}) * polynomial({-9, 20}) * polynomial({-3, 10}), Rational(1, 4), Rational(5, 16));
  ASSERT_LT(found.high, Rational(1, 2));
  EXPECT_EQ(found.roots.size(), 1U);
}

}  // namespace
}  // namespace folk
