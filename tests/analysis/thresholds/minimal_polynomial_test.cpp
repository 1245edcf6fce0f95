#include <folk/analysis/thresholds/minimal_polynomial.h>
#include <folk/analysis/thresholds/root_isolation.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace folk {
namespace {

Polynomial polynomial(std::vector<int> coefficients) {
  return Polynomial(std::vector<Integer>(coefficients.begin(), coefficients.end()));
}

AlgebraicNumber first_root(const Polynomial& p) {
  const RootIsolation found = isolate_roots(p);
  const RootInterval& root = found.roots.at(0);
  return {std::make_shared<const Polynomial>(found.polynomial), root.low, root.high};
}

TEST(MinimalPolynomial, OtherFactorsAreLeftOut) {
  const Polynomial minimal = polynomial({-1, 0, 3});
  EXPECT_EQ(minimal_polynomial(first_root(minimal * polynomial({1, 0, -1, 1}))), minimal);
  EXPECT_EQ(minimal_polynomial(first_root(minimal * minimal * polynomial({-5, 1, 1, 3}))), minimal);
  EXPECT_EQ(minimal_polynomial(first_root(-minimal)), minimal);
}

TEST(MinimalPolynomial, HighDegreesLoseAtLeastTheRootsOfUnity) {
  // d^13 + d - 1 is (d^2 - d + 1) times an irreducible one of degree 11
  std::vector<int> coefficients(14);
  coefficients[0] = -1;
  coefficients[1] = coefficients[13] = 1;
  EXPECT_EQ(minimal_polynomial(first_root(polynomial(coefficients) * polynomial({1, 1, 1}))).degree() % 2, 1U);
}

RC_GTEST_PROP(MinimalPolynomial, OfARandomIrreducibleOneTimesAnother, ()) {
  // Eisenstein at 2: all but the leading coefficient even, the constant not by 4.
  const auto degree = static_cast<std::size_t>(*rc::gen::inRange(2, 7));
  std::vector<int> coefficients(degree + 1);
  for (int& c : coefficients) c = 2 * *rc::gen::inRange(-3, 4);
  coefficients.front() = -2;
  coefficients.back() = 2 * *rc::gen::inRange(5, 20) + 1;  // a root in (0, 1): p(0) < 0 < p(1)
  const Polynomial irreducible = polynomial(coefficients);
  RC_PRE(irreducible.sign_at(1) > 0);
  RC_PRE(isolate_roots(irreducible).roots.size() == 1U);
  const Polynomial p = irreducible * polynomial({*rc::gen::inRange(1, 9), *rc::gen::inRange(1, 9), 1, 4});
  RC_ASSERT(minimal_polynomial(first_root(p)) == irreducible.primitive_part());
}

}  // namespace
}  // namespace folk
