// The scale of a data set's observations against the plain sums.

#include <folk/mpe/data/observation_scale.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "mpe/data/small_data_set.h"

namespace folk::mpe {
namespace {

/// (mean, deviation) of all numbers that an agent observes, each the float that learners see.
std::pair<double, double> naive_scale(const test::Arrays& arrays, std::size_t agent) {
  const auto& numbers = arrays.at("obs_" + std::to_string(agent) + ".npy").values;
  const auto count = static_cast<long double>(numbers.size());
  long double mean = 0;
  for (const double x : numbers) mean += static_cast<long double>(static_cast<float>(x)) / count;
  long double variance = 0;
  for (const double x : numbers)
    variance += std::pow(static_cast<long double>(static_cast<float>(x)) - mean, 2) / count;
  return {static_cast<double>(mean), static_cast<double>(std::sqrt(variance)) + 1e-6};
}

void expect_naive_scale(const test::Arrays& arrays, sct::NpyType type) {
  const auto files = test::files_of(arrays, type);
  const DataSet data = test::parse(files);
  const ObservationScale scale = measured_scale(data);
  ASSERT_EQ(scale.predators(), 3U);
  ASSERT_EQ(scale.deviation.size(), 3U);
  for (std::size_t predator = 0; predator < 3; ++predator) {
    const auto [mean, deviation] = naive_scale(arrays, predator);
    EXPECT_FLOAT_EQ(scale.mean[predator], static_cast<float>(mean));
    EXPECT_FLOAT_EQ(scale.deviation[predator], static_cast<float>(deviation));
  }
  EXPECT_NE(scale.mean[0], scale.mean[1]);
}

TEST(ObservationScale, IsThatOfThePlainSums) {
  for (const char* scenario : {"simple_tag", "simple_world"}) {
    const auto arrays = test::played_arrays(Layout(Scenario::named(scenario)), test::pursuit_cast(), 3, 0, 7);
    expect_naive_scale(arrays, sct::NpyType::float32);
    expect_naive_scale(arrays, sct::NpyType::float64);
  }
}

TEST(ObservationScale, IsTheSameOnAnyNumberOfThreads) {
  const auto arrays = test::played_arrays(Layout(Scenario::named("simple_tag")), test::pursuit_cast(), 3, 0, 200);
  expect_naive_scale(arrays, sct::NpyType::float32);
  const auto files = test::files_of(arrays);
  const DataSet data = test::parse(files);
  const ObservationScale alone = measured_scale(data, 1);
  EXPECT_EQ(measured_scale(data, 2), alone);
  EXPECT_EQ(measured_scale(data, 5), alone);
}

TEST(ObservationScale, OfNumbersThatAreAllTheSameDividesByALittle) {
  auto arrays = test::played_arrays(Layout(Scenario::named("simple_tag")), test::pursuit_cast(), 3, 0, 1);
  for (const char* name : {"obs_1.npy", "next_obs_1.npy"})
    arrays.at(name).values.assign(arrays.at(name).values.size(), 0.25);
  const auto files = test::files_of(arrays);
  const ObservationScale scale = measured_scale(test::parse(files));
  EXPECT_EQ(scale.mean[1], 0.25F);
  EXPECT_EQ(scale.deviation[1], 1e-6F);
}

TEST(ObservationScale, IsAppliedWithAPredatorsOwnNumbers) {
  const ObservationScale scale{{1, -2}, {4, 0.5F}};
  std::vector<float> numbers{3, -1, 1};
  scale.apply(0, numbers);
  EXPECT_EQ(numbers, (std::vector<float>{0.5F, -0.5F, 0}));
  numbers = {3, -1, 1};
  scale.apply(1, numbers);
  EXPECT_EQ(numbers, (std::vector<float>{10, 2, 6}));
}

}  // namespace
}  // namespace folk::mpe
