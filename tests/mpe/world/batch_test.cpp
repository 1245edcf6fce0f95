// Many episodes at once: each is what it would be alone, resets and states are put where they belong, and what is
// refused changes nothing.

#include <folk/mpe/world/batch.h>
#include <folk/mpe/world/random_stream.h>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "games/expect_error.h"
#include "mpe/world/random_states.h"

namespace folk::mpe {
namespace {

using folk::test::expect_error;

/// Everything there is to see of an episode.
struct Sight {
  EpisodeState state;
  std::vector<std::vector<double>> observations;
  std::vector<double> rewards;
  bool operator==(const Sight&) const = default;
};

Sight sight(const Batch& batch, std::size_t episode) {
  Sight sight{batch.state(episode), {}, {}};
  for (std::size_t agent = 0; agent < batch.scenario().agents(); ++agent) {
    sight.observations.push_back(batch.observation(episode, agent));
    sight.rewards.push_back(batch.reward(episode, agent));
  }
  return sight;
}

std::vector<Sight> sights(const Batch& batch) {
  std::vector<Sight> all;
  for (std::size_t e = 0; e < batch.size(); ++e) all.push_back(sight(batch, e));
  return all;
}

/// An action for each agent and episode by its number, some of them large; never the same at two steps.
void act(Batch& batch, std::uint64_t first, std::uint64_t step) {
  for (std::size_t e = 0; e < batch.size(); ++e)
    for (std::size_t agent = 0; agent < batch.scenario().agents(); ++agent) {
      RandomStream random({99, first + e, step, agent});
      const double size = agent == 1 ? 8 : 2;
      const double x = random.uniform();
      batch.set_action(e, agent, {size * (x - 0.5), size * (random.uniform() - 0.5)});
    }
}

/// Episodes `first` and on after `steps` steps.
Batch played(const char* scenario, std::size_t episodes, unsigned threads, std::uint64_t first, std::uint64_t steps) {
  Batch batch(Scenario::named(scenario), episodes, threads);
  batch.reset(7, first);
  for (std::uint64_t t = 0; t < steps; ++t) {
    act(batch, first, t);
    batch.step();
  }
  return batch;
}

constexpr const char* scenarios[] = {"simple_tag", "simple_world"};

// ---- an episode among others -----------------------------------------------------------------------------------

TEST(Batch, AnEpisodeIsTheSameInEveryBatch) {
  for (const char* scenario : scenarios) {
    std::vector<Sight> alone;
    for (std::uint64_t e = 0; e < 200; ++e) alone.push_back(sight(played(scenario, 1, 1, e, 12), 0));
    EXPECT_NE(alone[0], alone[1]);
    for (const std::size_t size : {1, 7, 8, 9, 63, 64, 65, 200}) {
      const auto together = sights(played(scenario, size, 1, 0, 12));
      for (std::size_t e = 0; e < size; ++e)
        EXPECT_EQ(together[e], alone[e]) << scenario << ", " << e << " of " << size;
    }
    EXPECT_EQ(sights(played(scenario, 30, 1, 50, 12)), std::vector<Sight>(alone.begin() + 50, alone.begin() + 80));
  }
}

// Small batches do not leave their thread; 8,197 episodes are three pieces of work.
TEST(BatchThreads, DoNotChangeABit) {
  for (const char* scenario : scenarios) {
    for (const std::size_t size : {1, 65, 200}) {
      const auto wanted = sights(played(scenario, size, 1, 3, 5));
      for (const unsigned threads : {0U, 2U, 5U}) EXPECT_EQ(sights(played(scenario, size, threads, 3, 5)), wanted);
    }
    const auto wanted = sights(played(scenario, 8197, 1, 3, 2));
    for (const unsigned threads : {2U, 5U}) EXPECT_EQ(sights(played(scenario, 8197, threads, 3, 2)), wanted);
  }
}

// What is too large for the caches is written past them.
TEST(BatchThreads, DoNotChangeABitOfALargeBatch) {
  const Batch large = played("simple_world", 90'001, 2, 0, 2);
  for (std::size_t e = 0; e < large.size(); e += 1875)
    EXPECT_EQ(sight(large, e), sight(played("simple_world", 1, 1, e, 2), 0)) << e;
}

TEST(BatchThreads, FindABadActionAnywhere) {
  Batch batch(Scenario::named("simple_tag"), 8197, 3);
  batch.reset(1);
  for (const std::size_t episode : {8196, 64, 0}) {
    const auto before = sight(batch, 0);
    batch.block(episode / block_lanes).actions[3 * block_lanes + episode % block_lanes] = std::nan("");
    expect_error<UsageError>([&] { batch.step(); },
                             "action of agent 1 in episode " + std::to_string(episode) + ": expected finite");
    EXPECT_EQ(sight(batch, 0), before);
  }
}

// ---- actions ---------------------------------------------------------------------------------------------------

TEST(Batch, RefusesActionsThatAreNotFinite) {
  const double infinity = std::numeric_limits<double>::infinity();
  Batch batch = played("simple_world", 20, 1, 0, 3);
  batch.set_action(13, 2, {0.25, -0.5});
  const auto before = sights(batch);
  for (const double bad : {std::nan(""), infinity, -infinity, 1.1e100, -1.1e100})
    for (const Point& action : {Point{bad, 0}, Point{0, bad}})
      expect_error<UsageError>([&] { batch.set_action(13, 2, action); }, " of agent 2 in episode 13: expected finite");
  expect_error<UsageError>([&] { batch.set_action(20, 0, {}); }, "episode 20 of a batch of 20");
  expect_error<UsageError>([&] { batch.set_action(0, 4, {}); }, "agent 4 of 4");
  EXPECT_EQ(sights(batch), before);
  EXPECT_EQ(batch.block(0).actions[4 * block_lanes + 13], 0.25);
  EXPECT_EQ(batch.block(0).actions[5 * block_lanes + 13], -0.5);
}

TEST(Batch, TakesTheLargestAction) {
  Batch batch(Scenario::named("simple_tag"), 1);
  batch.reset(1);
  batch.set_action(0, 0, {largest_action, -largest_action});
  batch.step();
  EXPECT_NEAR(batch.state(0).velocities[0].x, std::sqrt(0.5), 1e-15);
}

// Bad actions that were written into a block are found before anything moves, wherever they stand.
TEST(Batch, NothingMovesWhenAnActionIsBad) {
  const double infinity = std::numeric_limits<double>::infinity();
  Batch batch = played("simple_tag", 200, 1, 0, 3);
  const auto before = sights(batch);
  for (const double bad : {std::nan(""), infinity, -infinity, 1.1e100, -1.1e100})
    for (const std::size_t episode : {0, 7, 8, 63, 64, 130, 199})
      for (const std::size_t row : {0, 3, 7}) {
        double& action = batch.block(episode / block_lanes).actions[row * block_lanes + episode % block_lanes];
        const double good = std::exchange(action, bad);
        expect_error<UsageError>([&] { batch.step(); }, "action of agent " + std::to_string(row / 2) + " in episode " +
                                                            std::to_string(episode) + ":");
        action = good;
      }
  EXPECT_EQ(sights(batch), before);
  batch.step();
  EXPECT_NE(sights(batch), before);
}

// Lanes beyond the last episode mean nothing, whatever a player wrote there.
TEST(Batch, LanesThatAreNotInUseAreNotLookedAt) {
  Batch batch = played("simple_tag", 3, 1, 0, 3);
  Batch wanted = played("simple_tag", 3, 1, 0, 3);
  for (std::size_t row = 0; row < batch.layout().action_rows(); ++row)
    for (std::size_t lane = 3; lane < block_lanes; ++lane) batch.block(0).actions[row * block_lanes + lane] = NAN;
  EXPECT_FALSE(find_bad_action(batch.layout(), batch.block(0)).has_value());
  batch.step();
  wanted.step();
  EXPECT_EQ(sights(batch), sights(wanted));
}

TEST(Batch, ActionsStaySet) {
  Batch batch(Scenario::named("simple_tag"), 1);
  batch.reset(1);
  batch.set_action(0, 0, {0.01, 0});
  batch.step();
  const double once = batch.state(0).velocities[0].x;
  batch.step();
  EXPECT_GT(batch.state(0).velocities[0].x, once);
}

// ---- states ----------------------------------------------------------------------------------------------------

RC_GTEST_PROP(Batch, GivesBackTheStateThatWasSet, ()) {
  const auto scenario = Scenario::named(*rc::gen::element("simple_tag", "simple_world"));
  const auto episode = *rc::gen::inRange<std::size_t>(0, 70);
  auto state = *testing::any_state(scenario);
  state.positions[0].x = *rc::gen::element(-0.0, 1e100, -1e100, 5e-324, 0.1);
  Batch batch(scenario, 70);
  batch.reset(3);
  const auto before = sights(batch);
  batch.set_state(episode, state);
  RC_ASSERT(batch.state(episode) == state);
  RC_ASSERT(std::signbit(batch.state(episode).positions[0].x) == std::signbit(state.positions[0].x));
  for (std::size_t e = 0; e < batch.size(); ++e)
    if (e != episode) RC_ASSERT(sight(batch, e) == before[e]);
  // A state taken in the middle of an episode goes on as that episode does.
  Batch other(scenario, 1);
  other.set_state(0, state);
  RC_ASSERT(sight(other, 0) == sight(batch, episode));
  for (std::size_t agent = 0; agent < 4; ++agent) {
    batch.set_action(episode, agent, {0.5, -0.25});
    other.set_action(0, agent, {0.5, -0.25});
  }
  batch.step();
  other.step();
  RC_ASSERT(sight(other, 0) == sight(batch, episode));
}

TEST(Batch, RefusesStatesThatDoNotFit) {
  Batch batch = played("simple_tag", 3, 1, 0, 3);
  const auto before = sights(batch);
  const auto refuse = [&](auto change, const std::string& part) {
    auto state = batch.state(1);
    change(state);
    expect_error<UsageError>([&] { batch.set_state(1, state); }, part);
  };
  const std::string sizes = "simple_tag has 6 and 4";
  refuse([](EpisodeState& s) { s.positions.pop_back(); }, sizes);
  refuse([](EpisodeState& s) { s.positions.push_back({}); }, sizes);
  refuse([](EpisodeState& s) { s.velocities.pop_back(); }, sizes);
  refuse([](EpisodeState& s) { s.velocities.resize(6); }, sizes);
  refuse([](EpisodeState& s) { s = {}; }, sizes);
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL, 1.1e100}) {
    refuse([&](EpisodeState& s) { s.positions[5].y = bad; }, "not finite");
    refuse([&](EpisodeState& s) { s.positions[0].x = bad; }, "not finite");
    refuse([&](EpisodeState& s) { s.velocities[3].x = bad; }, "not finite");
  }
  expect_error<UsageError>([&] { batch.set_state(3, batch.state(0)); }, "episode 3 of a batch of 3");
  EXPECT_EQ(sights(batch), before);
}

TEST(Batch, RefusesPlacesOutsideIt) {
  Batch batch(Scenario::named("simple_tag"), 65);
  for (const std::size_t episode : {std::size_t{65}, std::size_t{127}, std::numeric_limits<std::size_t>::max()}) {
    expect_error<UsageError>([&] { batch.state(episode); }, "of a batch of 65");
    expect_error<UsageError>([&] { batch.observation(episode, 0); }, "of a batch of 65");
    expect_error<UsageError>([&] { batch.reward(episode, 0); }, "of a batch of 65");
    expect_error<UsageError>([&] { batch.reset_episode(episode, 1, 1); }, "of a batch of 65");
  }
  expect_error<UsageError>([&] { batch.observation(0, 4); }, "agent 4 of 4");
  expect_error<UsageError>([&] { batch.reward(0, 4); }, "agent 4 of 4");
  expect_error<UsageError>([] { Batch(Scenario::named("simple_tag"), 0); }, "at least one");
}

TEST(Batch, GivesItsBlocks) {
  Batch batch(Scenario::named("simple_world"), 130);
  batch.reset(1);
  ASSERT_EQ(batch.blocks(), 3U);
  EXPECT_EQ(batch.block(0).lanes, 64U);
  EXPECT_EQ(batch.block(1).lanes, 64U);
  EXPECT_EQ(batch.block(2).lanes, 2U);
  EXPECT_EQ(batch.block(1).state[16 * block_lanes + 5], batch.state(69).positions[4].x);
  EXPECT_EQ(batch.block(2).observations[(batch.layout().observation_begin(3) + 2) * block_lanes + 1],
            batch.state(129).positions[3].x);
  for (std::size_t b = 0; b < 3; ++b)
    for (const double* array :
         {batch.block(b).state, batch.block(b).actions, batch.block(b).observations, batch.block(b).rewards})
      EXPECT_EQ(reinterpret_cast<std::uintptr_t>(array) % 64, 0U);
}

// ---- resets ----------------------------------------------------------------------------------------------------

TEST(Reset, PlacesAgentsAndLandmarksUniformly) {
  for (const char* name : scenarios) {
    const auto scenario = Scenario::named(name);
    const std::size_t episodes = 20'000;
    Batch batch(scenario, episodes);
    batch.reset(2024);
    std::vector<double> sum(2 * scenario.entities.size()), squares(sum.size()), low(sum.size()), high(sum.size());
    for (std::size_t e = 0; e < episodes; ++e) {
      const auto state = batch.state(e);
      ASSERT_EQ(state.velocities, std::vector<Point>(4));
      for (std::size_t k = 0; k < sum.size(); ++k) {
        const double x = k % 2 == 0 ? state.positions[k / 2].x : state.positions[k / 2].y;
        sum[k] += x;
        squares[k] += x * x;
        low[k] = std::min(low[k], x);
        high[k] = std::max(high[k], x);
      }
    }
    for (std::size_t k = 0; k < sum.size(); ++k) {
      const double range = k / 2 < 4 ? 1 : 0.9;
      const double n = static_cast<double>(episodes);
      EXPECT_NEAR(sum[k] / n, 0, 4 * range / std::sqrt(3 * n)) << k;
      EXPECT_NEAR(squares[k] / n, range * range / 3, 4 * range * range * std::sqrt(4.0 / 45 / n)) << k;
      EXPECT_GE(low[k], -range);
      EXPECT_LE(high[k], range);
      EXPECT_LT(low[k], -range * 0.999);
      EXPECT_GT(high[k], range * 0.999);
    }
  }
}

TEST(Reset, EpisodesAreNumberedFromTheFirst) {
  Batch batch(Scenario::named("simple_world"), 70);
  batch.reset(5, 1000);
  Batch one(Scenario::named("simple_world"), 1);
  for (std::size_t e = 0; e < 70; ++e) {
    one.reset(5, 1000 + e);
    EXPECT_EQ(sight(one, 0), sight(batch, e));
    one.reset_episode(0, 5, 1000 + e);
    EXPECT_EQ(sight(one, 0), sight(batch, e));
  }
  one.reset(6, 1000);
  EXPECT_NE(one.state(0), batch.state(0));
  batch.reset(5);
  one.reset(5, 0);
  EXPECT_EQ(sight(one, 0), sight(batch, 0));
}

TEST(Reset, ForgetsTheEpisodeBefore) {
  Batch batch = played("simple_world", 70, 1, 0, 5);
  batch.reset(5);
  Batch fresh(Scenario::named("simple_world"), 70);
  fresh.reset(5);
  EXPECT_EQ(sights(batch), sights(fresh));
  EXPECT_EQ(batch.reward(3, 0), 0);
  EXPECT_EQ(batch.observation(69, 3)[2], batch.state(69).positions[3].x);
}

TEST(Reset, OfOneEpisodeLeavesItsNeighboursAlone) {
  for (const char* scenario : scenarios)
    for (const std::size_t episode : {0, 5, 7, 8, 63, 64, 69}) {
      Batch batch = played(scenario, 70, 1, 0, 5);
      const auto before = sights(batch);
      ASSERT_NE(before[0].rewards, std::vector<double>(4));
      const auto expect_others_as_before = [&] {
        for (std::size_t e = 0; e < 70; ++e) {
          if (e == episode) continue;
          EXPECT_EQ(sight(batch, e), before[e]) << e << " beside " << episode;
        }
      };
      batch.reset_episode(episode, 9, 1234);
      Batch fresh(Scenario::named(scenario), 1);
      fresh.reset(9, 1234);
      EXPECT_EQ(sight(batch, episode), sight(fresh, 0));
      EXPECT_EQ(batch.reward(episode, 0), 0);
      expect_others_as_before();
      NumpyRandom numpy(4);
      batch.reset_episode(episode, numpy);
      EXPECT_NE(batch.state(episode), fresh.state(0));
      EXPECT_EQ(batch.observation(episode, 0)[2], batch.state(episode).positions[0].x);
      expect_others_as_before();
    }
}

// np.random.seed(0); np.random.random_sample(3).
TEST(NumpyRandom, IsThatOfNumpy) {
  NumpyRandom zero(0);
  EXPECT_EQ(zero.uniform(), 0.5488135039273248);
  EXPECT_EQ(zero.uniform(), 0.7151893663724195);
  EXPECT_EQ(zero.uniform(), 0.6027633760716439);
}

TEST(RandomStreams, DifferInSeedUseEpisodeStepAndAgent) {
  const auto first = [](auto... key) { return random_stream(key...)(); };
  const auto zero = std::uint64_t{0};
  const auto one = first(1U, RandomUse::prey, zero, zero, zero);
  EXPECT_EQ(one, first(1U, RandomUse::prey, zero));
  EXPECT_NE(one, first(2U, RandomUse::prey, zero, zero, zero));
  EXPECT_NE(one, first(1U, RandomUse::coin, zero, zero, zero));
  EXPECT_NE(one, first(1U, RandomUse::prey, zero + 1, zero, zero));
  EXPECT_NE(one, first(1U, RandomUse::prey, zero, zero + 1, zero));
  EXPECT_NE(one, first(1U, RandomUse::prey, zero, zero, zero + 1));
}

}  // namespace
}  // namespace folk::mpe
