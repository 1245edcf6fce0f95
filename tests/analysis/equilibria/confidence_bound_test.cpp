#include <folk/analysis/equilibria/confidence_bound.h>
#include <folk/games/random.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace folk {
namespace {

const double natural = 2 / std::exp(1.0);  // ln(2 / failure) = 1

TEST(BernsteinBound, IsTheFormula) {
  EXPECT_NEAR(bernstein_bound(0, 10, 101, natural), 7.0 * 10 / (3 * 100), 1e-12);
  EXPECT_NEAR(bernstein_bound(50, 0, 100, natural), 1, 1e-12);  // sqrt(2 x 50 / 100)
  EXPECT_NEAR(bernstein_bound(50, 30, 8, natural), std::sqrt(100.0 / 8) + 10, 1e-12);
  EXPECT_NEAR(bernstein_bound(0, 3, 8, 2 / std::exp(5.0)), 5, 1e-12);
}

TEST(BernsteinBound, OfOneSampleIsAllThereIs) {
  EXPECT_EQ(bernstein_bound(0, 10, 0, 0.1), 10);
  EXPECT_EQ(bernstein_bound(0, 10, 1, 0.1), 10);
  EXPECT_NE(bernstein_bound(0, 10, 2, 0.1), 10);
}

/// 2,000 samples of 400 coins each: at most one in ten may lie farther on one side, two on both.
TEST(BernsteinBound, HoldsAsOftenAsItSays) {
  RandomStream random({71, 0, 0, 0});
  constexpr int experiments = 2000;
  constexpr std::size_t n = 400;
  int beyond = 0;
  double widest = 0;
  for (int i = 0; i < experiments; ++i) {
    double heads = 0;
    for (std::size_t k = 0; k < n; ++k) heads += random() % 10 == 0 ? 1 : 0;
    const double mean = heads / n;
    const double bound = bernstein_bound(mean * (1 - mean) * n / (n - 1), 1, n, 0.1);
    beyond += std::abs(mean - 0.1) > bound ? 1 : 0;
    widest = std::max(widest, bound);
  }
  EXPECT_LE(beyond, 2 * experiments / 10);
  EXPECT_LT(widest, 0.1);  // the range alone says 1
}

TEST(BernsteinBound, RefusesWhatIsNone) {
  EXPECT_THROW(bernstein_bound(-1, 1, 2, 0.1), std::logic_error);
  EXPECT_THROW(bernstein_bound(1, -1, 2, 0.1), std::logic_error);
  EXPECT_THROW(bernstein_bound(std::nan(""), 1, 2, 0.1), std::logic_error);
  EXPECT_THROW(bernstein_bound(1, 1, 2, 0), std::logic_error);
  EXPECT_THROW(bernstein_bound(1, 1, 2, 1), std::logic_error);
}

}  // namespace
}  // namespace folk
