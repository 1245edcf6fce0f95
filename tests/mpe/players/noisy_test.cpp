#include <folk/games/error.h>
#include <folk/mpe/evaluation/episode_record.h>
#include <folk/mpe/players/noisy.h>
#include <folk/mpe/players/scripted.h>
#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "games/expect_error.h"

namespace folk::mpe {
namespace {

using folk::test::expect_error;

const Layout& noisy_layout() {
  static const Layout noisy_layout(Scenario::named("simple_tag"));
  return noisy_layout;
}

Point action(const Cast& cast, std::uint64_t episode, std::size_t step, std::size_t agent) {
  return record_episode(noisy_layout(), cast, 3, episode).rows[step + 1].actions[agent];
}

TEST(Noisy, AddsNormalNumbersToEachAction) {
  const Cast cast{noisy(still_player(), 0.1), still_player()};
  double sum = 0;
  double squares = 0;
  int count = 0;
  for (std::uint64_t episode = 0; episode < 60; ++episode) {
    const auto record = record_episode(noisy_layout(), cast, 3, episode);
    for (std::size_t t = 1; t < record.rows.size(); ++t)
      for (std::size_t agent = 0; agent < 3; ++agent)
        for (const double u : {record.rows[t].actions[agent].x, record.rows[t].actions[agent].y}) {
          sum += u;
          squares += u * u;
          ++count;
        }
  }
  ASSERT_EQ(count, 9000);
  EXPECT_NEAR(sum / count, 0, 4 * 0.1 / std::sqrt(count));
  EXPECT_NEAR(squares / count, 0.01, 4 * 0.01 * std::sqrt(2.0 / count));
}

TEST(Noisy, IsAnotherForEachEpisodeStepAgentAndAxis) {
  const Cast cast{noisy(still_player(), 0.1), noisy(still_player(), 0.1)};
  const Point here = action(cast, 0, 0, 0);
  EXPECT_NE(here.x, here.y);
  EXPECT_NE(here.x, action(cast, 1, 0, 0).x);
  EXPECT_NE(here.x, action(cast, 0, 1, 0).x);
  EXPECT_NE(here.x, action(cast, 0, 0, 1).x);
  EXPECT_NE(here.x, action(cast, 0, 0, 3).x);
}

TEST(Noisy, CutsTheSum) {
  const Cast cast{noisy(greedy_pursuit(), 0.5), noisy(still_player(), 50)};
  bool inside = false;
  for (std::size_t step = 0; step < 25; ++step)
    for (std::size_t agent = 0; agent < 4; ++agent) {
      const Point u = action(cast, 0, step, agent);
      EXPECT_LE(std::abs(u.x), 1);
      EXPECT_LE(std::abs(u.y), 1);
      inside = inside || (agent < 3 && std::abs(u.x) < 1);
    }
  EXPECT_TRUE(inside);
  EXPECT_EQ(std::abs(action(cast, 0, 0, 3).x), 1);
}

TEST(Noisy, TellsThePlayerInsideOfEachStart) {
  struct Starts final : Player {
    explicit Starts(int& count)
        : count_(count) {}
    void start(const Layout&, const Block&, std::size_t, const Moment&) override { ++count_; }
    void act(const Layout&, const Block& block, std::size_t agent, const Moment&) override {
      const auto [x, y] = action_rows(block, agent);
      std::fill_n(x, block.lanes, 0.0);
      std::fill_n(y, block.lanes, 0.0);
    }
    int& count_;
  };
  int count = 0;
  const Controller starts{"starts", each([&](const Layout&, std::size_t) { return std::make_unique<Starts>(count); }),
                          true};
  const Controller disturbed = noisy(starts, 0.2);
  EXPECT_TRUE(disturbed.one_by_one);
  EXPECT_EQ(disturbed.name, "starts with noise 0.2");
  record_episode(noisy_layout(), {disturbed, still_player()}, 1, 0);
  EXPECT_EQ(count, 3);
}

TEST(Noisy, WithoutNoiseItIsThePlayer) {
  const Cast cast{noisy(greedy_pursuit(), 0), still_player()};
  EXPECT_EQ(cast.predators.name, "greedy_pursuit");
  EXPECT_EQ(action(cast, 0, 0, 0), action({greedy_pursuit(), still_player()}, 0, 0, 0));
  for (const double sigma : {-0.1, std::nan(""), 101.0, HUGE_VAL})
    expect_error<UsageError>([&] { noisy(still_player(), sigma); }, "expected a standard deviation");
}

}  // namespace
}  // namespace folk::mpe
