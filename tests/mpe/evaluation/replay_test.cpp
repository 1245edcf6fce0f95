// The world against episodes that the published program recorded, and what a replay says of wrong ones.

#include <folk/mpe/evaluation/recording_file.h>
#include <folk/mpe/evaluation/replay.h>
#include <folk/mpe/players/scripted.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "games/expect_error.h"
#include "mpe/evaluation/golden_recordings.h"

namespace folk::mpe {
namespace {

using testing::golden_data;
using testing::golden_recordings;

void expect_within(const std::filesystem::path& file, ReplayMode mode, double tolerance) {
  for (const auto& episode : read_recording(file)) {
    const ReplayResult result = replay(episode, mode);
    const Deviation& largest = result.largest();
    EXPECT_TRUE(result.within(tolerance)) << file << ": " << largest.size << " at t = " << largest.step << ", "
                                          << largest.column << "; allowed is " << tolerance;
    EXPECT_EQ(result.steps + 1, episode.rows.size());
  }
}

TEST(Replay, OneStepOfEveryGoldenEpisode) {
  const auto files = golden_recordings();
  ASSERT_GE(files.size(), 8U);
  for (const auto& file : files) expect_within(file, ReplayMode::one_step, 1e-12);
}

TEST(Replay, ActionsThatWereRoundedToFloat) {
  const auto files = golden_recordings("f32actions");
  ASSERT_EQ(files.size(), 2U);
  for (const auto& file : files) {
    expect_within(file, ReplayMode::one_step, 1e-6);
    EXPECT_FALSE(replay(read_recording(file).front()).within(1e-12)) << file << ": the force was rounded there";
  }
}

TEST(Replay, FreeRunsOfEveryGoldenEpisode) {
  // Where agents pile up, a start 1e-14 away ends more than 1e-11 away (index_tag.csv, index_world.csv).
  const std::set<std::string> chaotic{"tag_01",   "tag_02",   "tag_05",   "tag_06",   "tag_12",  "world_01",
                                      "world_02", "world_05", "world_06", "world_12", "world_13"};
  for (const auto& file : golden_recordings())
    expect_within(file, ReplayMode::free_run, chaotic.contains(file.stem().string()) ? 1e-3 : 1e-9);
}

/// An episode of this world's own.
EpisodeRecord own_episode(const char* scenario = "simple_world") {
  const Layout layout(Scenario::named(scenario));
  return record_episode(layout, {lead_pursuit(), random_player()}, 5, 7);
}

TEST(Replay, OwnEpisodesAreRepeatedToTheBit) {
  for (const char* scenario : {"simple_tag", "simple_world"})
    for (const ReplayMode mode : {ReplayMode::one_step, ReplayMode::free_run}) {
      const auto result = replay(own_episode(scenario), mode);
      EXPECT_EQ(result.largest().size, 0);
      EXPECT_EQ(result.largest().column, "");
      EXPECT_EQ(result.steps, 25U);
    }
}

TEST(Replay, ARewardWrittenDownByTheOtherRule) {
  auto record = read_recording(golden_data("tag_01.csv"), RewardRule::paper).front();
  const auto result = replay(record);
  EXPECT_TRUE(result.state.within(1e-12));
  EXPECT_FALSE(result.reward.within(1e-3));
}

// Each kind of column, in the first row, the middle and the last.
TEST(Replay, SaysWhereADeviationIs) {
  const auto expect_at = [](const EpisodeRecord& record, const Deviation ReplayResult::*kind, std::size_t step,
                            const std::string& column, double size) {
    for (const ReplayMode mode : {ReplayMode::one_step, ReplayMode::free_run}) {
      const auto result = replay(record, mode);
      EXPECT_EQ((result.*kind).column, column);
      EXPECT_EQ((result.*kind).step, step);
      EXPECT_NEAR((result.*kind).size, size, 1e-9);
      EXPECT_EQ(result.largest().column, column);
      EXPECT_FALSE(result.within(size / 2));
    }
  };
  for (const std::size_t step : {std::size_t{0}, std::size_t{9}, std::size_t{25}}) {
    auto record = own_episode();
    record.rows[step].observations[3][21] += 3;
    expect_at(record, &ReplayResult::observation, step, "obs3.21", 3);
    record = own_episode();
    record.rows[step].rewards[2] -= 100;
    expect_at(record, &ReplayResult::reward, step, "rew2", 100);
  }
  auto record = own_episode();
  record.rows[25].state.velocities[3].y += 50;
  expect_at(record, &ReplayResult::state, 25, "agent3.vy", 50);
}

TEST(Replay, OneStepForgetsWhatFreeRunRemembers) {
  auto record = own_episode();
  record.rows[10].actions[0].x += record.rows[10].actions[0].x > 0 ? -1 : 1;
  const auto one = replay(record);
  EXPECT_EQ(one.state.step, 10U);
  EXPECT_EQ(one.state.column, "agent0.vx");
  EXPECT_GT(replay(record, ReplayMode::free_run).state.step, 10U);
}

TEST(Replay, NotANumberIsNeverWithin) {
  auto record = own_episode();
  record.rows[3].rewards[1] = std::numeric_limits<double>::quiet_NaN();
  record.rows[5].rewards[1] += 1e9;
  const auto result = replay(record);
  EXPECT_TRUE(std::isnan(result.largest().size));
  EXPECT_EQ(result.largest().column, "rew1");
  EXPECT_EQ(result.largest().step, 3U);
  EXPECT_FALSE(result.within(1e300));
  EXPECT_FALSE(result.reward.within(std::numeric_limits<double>::infinity()));
  EXPECT_TRUE(result.state.within(0));

  Deviation not_a_number{std::numeric_limits<double>::quiet_NaN()};
  EXPECT_TRUE(less(Deviation{1e300}, not_a_number));
  EXPECT_FALSE(less(not_a_number, Deviation{1e300}));
  EXPECT_FALSE(less(not_a_number, not_a_number));
}

TEST(Replay, RecordsThatMakeNoSense) {
  auto record = own_episode();
  record.rows.resize(1);
  test::expect_error<UsageError>([&] { replay(record); }, "without a step");
  record = own_episode();
  record.rows[4].observations[0].pop_back();
  test::expect_error<UsageError>([&] { replay(record); }, "not one of simple_world");
  record = own_episode();
  record.rows[4].actions.pop_back();
  test::expect_error<UsageError>([&] { replay(record); }, "not one of simple_world");
  record = own_episode();
  record.rows[4].actions[1].x = std::numeric_limits<double>::infinity();
  test::expect_error<UsageError>([&] { replay(record); }, "finite");
  record = own_episode();
  record.rows[0].state.positions[8].x = std::numeric_limits<double>::quiet_NaN();
  test::expect_error<UsageError>([&] { replay(record); }, "finite");
}

}  // namespace
}  // namespace folk::mpe
