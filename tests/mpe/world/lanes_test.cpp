#include <folk/games/random.h>
#include <folk/mpe/world/lanes.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <vector>

#pragma GCC diagnostic ignored "-Wpsabi"  // functions of vectors are called in this file alone

namespace folk::mpe {
namespace {

using Lanes = std::array<double, vector_lanes>;

Lanes lanes_of(const Vector& v) {
  Lanes lanes;
  std::memcpy(lanes.data(), &v, sizeof v);
  return lanes;
}

Vector vector_of(const Lanes& lanes) {
  Vector v;
  std::memcpy(&v, lanes.data(), sizeof v);
  return v;
}

/// How many doubles lie between two of one sign.
std::uint64_t places_between(double a, double b) {
  const auto x = std::bit_cast<std::int64_t>(a);
  const auto y = std::bit_cast<std::int64_t>(b);
  return static_cast<std::uint64_t>(std::abs(x - y));
}

/// The largest difference in the last place between a function and the standard library's, over many numbers.
std::uint64_t largest_error(const std::vector<double>& numbers, Vector (*ours)(const Vector&),
                            double (*theirs)(double)) {
  std::uint64_t worst = 0;
  for (std::size_t i = 0; i + vector_lanes <= numbers.size(); i += vector_lanes) {
    Lanes lanes;
    std::copy_n(numbers.begin() + static_cast<std::ptrdiff_t>(i), vector_lanes, lanes.begin());
    const Lanes found = lanes_of(ours(vector_of(lanes)));
    for (std::size_t k = 0; k < vector_lanes; ++k) worst = std::max(worst, places_between(found[k], theirs(lanes[k])));
  }
  return worst;
}

/// Numbers spread evenly over [low, high], over the orders of magnitude in it, and its ends.
std::vector<double> numbers_within(double low, double high) {
  RandomStream random;
  std::vector<double> numbers{low, high, 0, std::min(high, 1e-300), std::min(high, 1e-17), low / 2, high / 2, high / 3};
  for (int i = 0; i < 40'000; ++i) {
    numbers.push_back(low + (high - low) * random.uniform());
    numbers.push_back((random.chance(0.5) ? low : high) * std::exp(-40 * random.uniform()));
  }
  return numbers;
}

TEST(Lanes, ExponentialIsRightToFourPlaces) {
  const auto ours = [](const Vector& x) { return exponential(x); };
  EXPECT_LE(largest_error(numbers_within(-700, 700), ours, [](double x) { return std::exp(x); }), 4U);
  EXPECT_LE(largest_error(numbers_within(-1, 1), ours, [](double x) { return std::exp(x); }), 4U);
  EXPECT_EQ(lanes_of(exponential(all_lanes(0)))[3], 1.0);
}

TEST(Lanes, LogarithmOfOnePlusIsRightToFourPlaces) {
  const auto ours = [](const Vector& x) { return log_of_one_plus(x); };
  EXPECT_LE(largest_error(numbers_within(0, 1), ours, [](double x) { return std::log1p(x); }), 4U);
  EXPECT_EQ(lanes_of(log_of_one_plus(all_lanes(0)))[3], 0.0);
}

TEST(Lanes, SquareRootIsTheStandardOne) {
  EXPECT_EQ(largest_error(
                numbers_within(0, 1e300), [](const Vector& x) { return square_root(x); },
                [](double x) { return std::sqrt(x); }),
            0U);
}

TEST(Lanes, PolynomialHasEachTerm) {
  const Vector x = vector_of({-2, -1, 0, 1, 2, 3, 10, 0.5});
  const auto two = lanes_of(polynomial(x, std::array{3.0, 5.0}));
  const auto three = lanes_of(polynomial(x, std::array{3.0, 5.0, 7.0}));
  const auto six = lanes_of(polynomial(x, std::array{3.0, 5.0, 7.0, 11.0, 13.0, 17.0}));
  for (std::size_t i = 0; i < vector_lanes; ++i) {
    const double t = x[i];
    EXPECT_EQ(two[i], 3 + 5 * t);
    EXPECT_EQ(three[i], 3 + t * (5 + t * 7));
    EXPECT_EQ(six[i], 3 + t * (5 + t * (7 + t * (11 + t * (13 + t * 17)))));
  }
}

TEST(Lanes, MinimumAndAbsoluteAreOfEachLane) {
  const Vector a = vector_of({1, -1, 0, 5, -7, 1e300, 2, 2});
  const Vector b = vector_of({2, -2, 0, -5, 7, -1e300, 2, 1});
  EXPECT_EQ(lanes_of(minimum(a, b)), (Lanes{1, -2, 0, -5, -7, -1e300, 2, 1}));
  EXPECT_EQ(lanes_of(absolute(a)), (Lanes{1, 1, 0, 5, 7, 1e300, 2, 2}));
  EXPECT_EQ(lanes_of(all_lanes(3)), (Lanes{3, 3, 3, 3, 3, 3, 3, 3}));
}

TEST(Lanes, AnyFindsOneLaneOfEight) {
  EXPECT_FALSE(any(Mask{}));
  for (std::size_t i = 0; i < vector_lanes; ++i) {
    Lanes lanes{};
    lanes[i] = 1;
    EXPECT_TRUE(any(vector_of(lanes) > 0));
    EXPECT_FALSE(any(vector_of(lanes) < 0));
  }
}

TEST(Lanes, StoreWhatWasLoaded) {
  alignas(64) Lanes from;
  std::iota(from.begin(), from.end(), 1.0);
  alignas(64) Lanes through{};
  alignas(64) Lanes past{};
  store(through.data(), load(from.data()));
  store_past_caches(past.data(), load(from.data()));
  fence_stores();
  EXPECT_EQ(through, from);
  EXPECT_EQ(past, from);
}

}  // namespace
}  // namespace folk::mpe
