#pragma once
// What every controller must keep to, whatever it plays: expect_sound_controller(controller, side, scenario).

#include <folk/mpe/players/scripted.h>
#include <folk/mpe/world/batch.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace folk::mpe::testing {

/// What the agents of one side did in an episode: agent after agent, step after step.
using Deeds = std::vector<Point>;

/// Players that stay, and a block to play in; the other side moves at random.
class Table {
public:
  Table(const Layout& layout, const Controller& controller, Side side)
      : layout_(layout),
        side_(side),
        batch_(layout.scenario(), controller.one_by_one ? 1 : block_lanes),
        players_((side == Side::prey ? Cast{random_player(), controller} : Cast{controller, random_player()})
                     .players(layout)) {}

  /// The deeds in `lanes` episodes from `first` on.
  std::vector<Deeds> play(std::uint64_t seed, std::uint64_t first, std::size_t lanes) {
    batch_.reset(seed, first);
    Block block = batch_.block(0);
    block.lanes = lanes;
    Moment moment{seed, first, 0};
    std::vector<Deeds> deeds(lanes);
    for (std::size_t agent = 0; agent < players_.size(); ++agent) players_[agent]->start(layout_, block, agent, moment);
    for (; moment.step < layout_.scenario().episode_steps; ++moment.step) {
      for (std::size_t agent = 0; agent < players_.size(); ++agent) act(block, agent, moment, deeds);
      step(layout_, block);
    }
    return deeds;
  }

private:
  void act(const Block& block, std::size_t agent, const Moment& moment, std::vector<Deeds>& deeds) {
    const auto [x, y] = action_rows(block, agent);
    // The first to be asked may look at what all did in the step before.
    if (agent > 0 || moment.step == 0) {
      std::fill_n(x, block.lanes, std::numeric_limits<double>::quiet_NaN());
      std::fill_n(y, block.lanes, std::numeric_limits<double>::quiet_NaN());
    }
    const auto before = all_but_actions_of(block, agent);
    players_[agent]->act(layout_, block, agent, moment);
    EXPECT_EQ(all_but_actions_of(block, agent), before) << "agent " << agent << " wrote what is not its own";
    if (side_of(layout_, agent) != side_) return;
    const auto within = [](double number) { return std::abs(number) <= 1; };  // NaN is no answer either
    EXPECT_TRUE(std::all_of(x, x + block.lanes, within) && std::all_of(y, y + block.lanes, within))
        << "agent " << agent << ", step " << moment.step;
    for (std::size_t lane = 0; lane < block.lanes; ++lane) deeds[lane].push_back({x[lane], y[lane]});
  }

  std::vector<double> all_but_actions_of(const Block& block, std::size_t agent) const {
    std::vector<double> numbers;
    const auto add = [&](const double* rows, std::size_t begin, std::size_t end) {
      for (std::size_t row = begin; row < end; ++row)
        numbers.insert(numbers.end(), rows + row * block_lanes, rows + row * block_lanes + block.lanes);
    };
    add(block.state, 0, layout_.state_rows());
    add(block.observations, 0, layout_.observation_rows());
    add(block.rewards, 0, layout_.reward_rows());
    add(block.actions, 0, 2 * agent);  // those after it have not acted yet
    return numbers;
  }

  const Layout& layout_;
  Side side_;
  Batch batch_;
  Team players_;
};

/// The deeds of a few episodes, each in a block of its own.
inline std::vector<Deeds> one_by_one(Table& table, const std::vector<std::uint64_t>& episodes) {
  std::vector<Deeds> deeds;
  for (const std::uint64_t episode : episodes) deeds.push_back(table.play(5, episode, 1).front());
  return deeds;
}

/// Some of many.
template <class T>
std::vector<T> part(const std::vector<T>& all, std::size_t begin, std::size_t count) {
  const auto first = all.begin() + static_cast<std::ptrdiff_t>(begin);
  return {first, first + static_cast<std::ptrdiff_t>(count)};
}

/// Expects a controller to answer with finite actions in [-1, 1]^2, to write nothing else, and to play an episode the
/// same alone, in any block, again, and after any other episodes.
inline void expect_sound_controller(const Controller& controller, Side side, const Scenario& scenario) {
  const ::testing::ScopedTrace trace(__FILE__, __LINE__, controller.name + " in " + scenario.name);
  EXPECT_FALSE(controller.name.empty());
  EXPECT_TRUE(std::all_of(controller.name.begin(), controller.name.end(),
                          [](char c) { return static_cast<unsigned char>(c) >= 0x20; }));
  const Layout layout(scenario);
  Table table(layout, controller, side);
  const auto alone = one_by_one(table, {1000, 1007, 1008, 1063});
  EXPECT_EQ(one_by_one(table, {1063, 1008, 1000, 1007}), (std::vector<Deeds>{alone[3], alone[2], alone[0], alone[1]}));
  Table other(layout, controller, side);
  EXPECT_EQ(one_by_one(other, {1007}).front(), alone[1]);
  if (controller.one_by_one) return;
  const auto together = other.play(5, 1000, 64);
  EXPECT_EQ((std::vector<Deeds>{together[0], together[7], together[8], together[63]}), alone);
  EXPECT_EQ(part(table.play(5, 1030, 41), 0, 34), part(together, 30, 34));
  EXPECT_EQ(table.play(5, 1000, 64), together);
  EXPECT_EQ(table.play(5, 1000, 9), part(together, 0, 9));
}

}  // namespace folk::mpe::testing
