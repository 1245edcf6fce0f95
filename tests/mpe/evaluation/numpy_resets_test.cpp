// Resets that numpy's generator gave the published program, from its seeds.

#include <folk/mpe/evaluation/episode_record.h>
#include <folk/mpe/evaluation/numpy_starts.h>
#include <folk/mpe/evaluation/scores.h>
#include <folk/mpe/players/scripted.h>
#include <folk/mpe/world/batch.h>

#include <gtest/gtest.h>

#include "csv.h"

namespace folk::mpe {
namespace {

void expect_resets(const std::string& file, const char* scenario) {
  const auto rows = folk::test::read_csv("mpe/" + file);
  ASSERT_EQ(rows.size(), 21U);
  Batch batch(Scenario::named(scenario), 3);
  std::optional<NumpyRandom> random;
  for (std::size_t row = 1; row < rows.size(); ++row) {
    if (rows[row][1] == "0") random.emplace(static_cast<std::uint32_t>(std::stoul(rows[row][0])));
    batch.reset_episode(1, *random);
    const auto state = batch.state(1);
    ASSERT_EQ(rows[row].size(), 2 + 2 * state.positions.size());
    for (std::size_t i = 0; i < state.positions.size(); ++i) {
      EXPECT_EQ(state.positions[i].x, std::stod(rows[row][2 + 2 * i])) << file << ", line " << row + 1 << ", " << i;
      EXPECT_EQ(state.positions[i].y, std::stod(rows[row][3 + 2 * i])) << file << ", line " << row + 1 << ", " << i;
    }
    for (const Point& velocity : state.velocities) EXPECT_EQ(velocity, Point());
  }
}

TEST(NumpyResets, OfSimpleTag) { expect_resets("tag_reset_seeds.csv", "simple_tag"); }
TEST(NumpyResets, OfSimpleWorld) { expect_resets("world_reset_seeds.csv", "simple_world"); }

TEST(NumpyStarts, AreOneStreamOfResets) {
  const auto rows = folk::test::read_csv("mpe/world_reset_seeds.csv");
  const auto starts = numpy_starts(Scenario::named("simple_world"), 3, 4);
  ASSERT_EQ(starts.size(), 4U);
  for (std::size_t row = 1; row < rows.size(); ++row) {
    if (rows[row][0] != "3") continue;
    for (std::size_t i = 0; i < 9; ++i)
      EXPECT_EQ(starts[std::stoul(rows[row][1])].positions[i].x, std::stod(rows[row][2 + 2 * i]));
  }
}

TEST(NumpyStarts, AreWhereThePlannedEpisodesBegin) {
  const Layout layout(Scenario::named("simple_tag"));
  const auto starts = numpy_starts(layout.scenario(), 7, 150);
  EpisodePlan plan{1, 0, 150, 2, placed_at(starts)};
  const auto scores = score_episodes(layout, {lead_pursuit(), still_player()}, plan);
  plan.first = 130;
  const auto record = record_episode(layout, {lead_pursuit(), still_player()}, plan);
  EXPECT_EQ(record.rows.front().state, starts[130]);
  EXPECT_EQ(record.number, 130U);
  double sum = 0;
  for (const auto& row : record.rows) sum += row.rewards[0];
  EXPECT_EQ(scores[130].predators, sum);
}

}  // namespace
}  // namespace folk::mpe
