#include <folk/analysis/replies/box_search.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace folk {
namespace {

/// Global, then local.
BoxOptimum search(const BoxFunction& function, const Box& box) {
  return climb(function, box, explore(function, box, 500).point, 1000, 1e-10);
}

TEST(BoxSearch, FindsTheHighestOfManyHills) {
  const BoxFunction hills = [](const std::vector<double>& x) {
    return std::cos(20 * (x[0] - 0.7)) - 3 * std::pow(x[0] - 0.7, 2) - std::pow(x[1] - 0.2, 2);
  };
  const BoxOptimum found = search(hills, {{0, 0}, {1, 1}});
  EXPECT_NEAR(found.point[0], 0.7, 1e-6);
  EXPECT_NEAR(found.point[1], 0.2, 1e-6);
  EXPECT_NEAR(found.value, 1, 1e-12);
  EXPECT_TRUE(found.settled);
}

TEST(BoxSearch, OnAnIntervalAndAtItsEnd) {
  const BoxOptimum inside = search([](const auto& x) { return -std::pow(x[0] - 0.3, 2); }, {{-1}, {1}});
  EXPECT_NEAR(inside.point[0], 0.3, 1e-6);
  const BoxOptimum end = search([](const auto& x) { return x[0]; }, {{-1}, {1}});
  EXPECT_EQ(end.point[0], 1);
}

TEST(BoxSearch, TakesAFunctionThatIsFlatOrSteepAtACorner) {
  EXPECT_EQ(search([](const auto&) { return 2.0; }, {{0, 0, 0}, {1, 1, 1}}).value, 2);
  const auto steep = [](const auto& x) { return std::sqrt(x[0]) - std::sqrt(1 - x[1]); };
  EXPECT_NEAR(search(steep, {{0, 0}, {1, 1}}).value, 1, 1e-4);
}

TEST(BoxSearch, TakesAStartThatRoundingPutOutside) {
  const BoxOptimum found =
      climb([](const auto& x) { return -x[0] * x[0] - x[1]; }, {{0, 0}, {1, 1}}, {-1e-17, 2}, 200, 1e-9);
  EXPECT_NEAR(found.value, 0, 1e-9);
}

TEST(BoxSearch, StopsAtItsNumberOfPoints) {
  std::size_t calls = 0;
  const auto counted = [&](const std::vector<double>& x) {
    ++calls;
    return std::sin(9 * x[0] * x[1]) + x[0];
  };
  const Box box{{0, 0}, {1, 1}};
  EXPECT_EQ(explore(counted, box, 40).points, calls);
  EXPECT_LE(calls, 60U);  // DIRECT ends the round it is in
  const BoxOptimum found = climb(counted, box, {0.5, 0.5}, 6, 1e-9);
  EXPECT_EQ(found.points, 6U);
  EXPECT_FALSE(found.settled);
}

TEST(BoxSearch, PassesOnWhatTheFunctionThrows) {
  const auto fails = [](const std::vector<double>&) -> double { throw std::runtime_error("no value"); };
  EXPECT_THROW(explore(fails, {{0, 0}, {1, 1}}, 50), std::runtime_error);
  EXPECT_THROW(climb(fails, {{0, 0}, {1, 1}}, {0.5, 0.5}, 50, 1e-9), std::runtime_error);
}

}  // namespace
}  // namespace folk
