// The windows that a transformer learns from against a plain reading of the data.

#include <folk/mpe/data/observation_scale.h>
#include <folk/mpe/offline/transformer_windows.h>

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "mpe/data/small_data_set.h"

namespace folk::mpe {
namespace {

/// A few episodes as arrays and as data.
struct WindowSpecimen {
  explicit WindowSpecimen(const char* scenario, std::size_t episodes = 4)
      : arrays(test::played_arrays(Layout(Scenario::named(scenario)), test::pursuit_cast(), 3, 0, episodes)),
        files(test::files_of(arrays)),
        data(test::parse(files)) {}

  test::Arrays arrays;
  test::Files files;
  DataSet data;
};

const WindowSpecimen& tag() {
  static const WindowSpecimen specimen("simple_tag");
  return specimen;
}

/// A window where it begins, found by what the prey did.
std::pair<std::size_t, std::size_t> place_of(const WindowSpecimen& specimen, const sct::Batch<float>& batch,
                                             std::size_t round) {
  const auto start = static_cast<std::size_t>(batch.timesteps[round]);
  const auto& prey = specimen.arrays.at("acs_3.npy").values;
  for (std::size_t episode = 0; episode < specimen.data.episodes(); ++episode) {
    const std::size_t row = 25 * episode + start;
    if (batch.opponent.numbers[2 * round] == static_cast<float>(prey[2 * row]) &&
        batch.opponent.numbers[2 * round + 1] == static_cast<float>(prey[2 * row + 1]))
      return {episode, start};
  }
  ADD_FAILURE() << "no episode has this";
  return {0, start};
}

/// Holds every number of a batch against the arrays.
void expect_plain(const WindowSpecimen& specimen, const sct::Batch<float>& batch, const ObservationScale& scale,
                  double return_scale, std::size_t windows, std::size_t length) {
  const std::size_t size = specimen.data.scenario().observation_size(0);
  ASSERT_EQ(batch.window_rounds, std::vector<std::size_t>(windows, length));
  ASSERT_EQ(batch.timesteps.size(), windows * length);
  ASSERT_EQ(batch.returns.size(), windows * length);
  ASSERT_EQ(batch.observations.size(), windows * length * 3 * size);
  ASSERT_EQ(batch.opponent.numbers.size(), windows * length * 2);
  ASSERT_EQ(batch.own.numbers.size(), windows * length * 6);
  for (std::size_t w = 0; w < windows; ++w) {
    const auto [episode, start] = place_of(specimen, batch, w * length);
    ASSERT_LE(start + length, 25U);
    for (std::size_t t = 0; t < length; ++t) {
      const std::size_t round = w * length + t;
      const std::size_t row = 25 * episode + start + t;
      ASSERT_EQ(batch.timesteps[round], static_cast<std::int32_t>(start + t));
      double to_go = 0;
      for (std::size_t later = row; later < 25 * (episode + 1); ++later)
        to_go += static_cast<double>(static_cast<float>(specimen.arrays.at("rews_0.npy").values[later]));
      ASSERT_NEAR(batch.returns[round], to_go / return_scale, 1e-5 * (1 + std::abs(to_go)));
      for (std::size_t k = 0; k < 2; ++k)
        ASSERT_EQ(batch.opponent.numbers[2 * round + k],
                  static_cast<float>(specimen.arrays.at("acs_3.npy").values[2 * row + k]));
      for (std::size_t i = 0; i < 3; ++i) {
        const std::string file = std::to_string(i) + ".npy";
        for (std::size_t k = 0; k < 2; ++k)
          ASSERT_EQ(batch.own.numbers[(3 * round + i) * 2 + k],
                    static_cast<float>(specimen.arrays.at("acs_" + file).values[2 * row + k]));
        for (std::size_t k = 0; k < size; ++k)
          ASSERT_NEAR(batch.observations[(3 * round + i) * size + k],
                      (specimen.arrays.at("obs_" + file).values[size * row + k] - static_cast<double>(scale.mean[i])) /
                          static_cast<double>(scale.deviation[i]),
                      1e-5);
      }
    }
  }
}

TEST(TransformerWindows, AreStretchesOfTheData) {
  for (const char* scenario : {"simple_tag", "simple_world"}) {
    const WindowSpecimen specimen(scenario);
    const auto scale = measured_scale(specimen.data);
    for (const std::size_t context : {1, 5, 20, 25})
      expect_plain(specimen, draw_windows(specimen.data, scale, 100, 30, context, 7, 3), scale, 100, 30, context);
    const ObservationScale other{{1, 2, 3}, {0.5F, 4, 8}};
    expect_plain(specimen, draw_windows(specimen.data, other, 0.5, 10, 20, 7, 3), other, 0.5, 10, 20);
  }
}

TEST(TransformerWindows, AreWholeEpisodesWhereTheContextIsLonger) {
  const auto scale = measured_scale(tag().data);
  for (const std::size_t context : {26, 100})
    expect_plain(tag(), draw_windows(tag().data, scale, 100, 12, context, 7, 3), scale, 100, 12, 25);
}

/// Every episode and start as often as every other: chi-squared over all pairs.
TEST(TransformerWindows, BeginAnywhereInAnyEpisodeEquallyOften) {
  const auto scale = measured_scale(tag().data);
  const std::size_t context = 20;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> counts;
  constexpr std::size_t drawn = 4800;
  for (std::uint64_t step = 0; step < drawn / 64; ++step) {
    const auto batch = draw_windows(tag().data, scale, 100, 64, context, 5, step);
    for (std::size_t w = 0; w < 64; ++w) ++counts[place_of(tag(), batch, w * context)];
  }
  EXPECT_EQ(counts.size(), 4U * 6);
  double chi_squared = 0;
  for (const auto& [place, count] : counts) chi_squared += std::pow(static_cast<double>(count) - 200, 2) / 200;
  EXPECT_LT(chi_squared, 49.7);  // 23 degrees of freedom, 0.1 %
  EXPECT_GT(chi_squared, 7.5);   // nor too evenly
}

TEST(TransformerWindows, DependOnSeedAndStepAlone) {
  const auto scale = measured_scale(tag().data);
  const auto drawn = [&](std::uint64_t seed, std::uint64_t step, std::size_t windows = 8) {
    const auto batch = draw_windows(tag().data, scale, 100, windows, 20, seed, step);
    return std::tuple(batch.timesteps, batch.returns, batch.observations, batch.opponent.numbers, batch.own.numbers);
  };
  const auto first = drawn(1, 0);
  EXPECT_NE(drawn(1, 1), first);
  EXPECT_NE(drawn(2, 0), first);
  EXPECT_EQ(drawn(1, 0), first);
}

TEST(TransformerWindows, LookAtPredatorZerosRewardsAlone) {
  auto arrays = tag().arrays;
  for (const char* name : {"rews_1.npy", "rews_2.npy", "rews_3.npy"})
    for (double& reward : arrays.at(name).values) reward += 3;
  const auto files = test::files_of(arrays);
  const DataSet changed = test::parse(files);
  const auto scale = measured_scale(tag().data);
  EXPECT_EQ(draw_windows(changed, scale, 100, 5, 20, 1, 1).returns,
            draw_windows(tag().data, scale, 100, 5, 20, 1, 1).returns);
}

}  // namespace
}  // namespace folk::mpe
