#include <folk/mpe/world/scenario.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "games/expect_error.h"

namespace folk::mpe {
namespace {

using folk::test::expect_error;

std::vector<std::size_t> observation_sizes(const Scenario& scenario) {
  std::vector<std::size_t> sizes;
  for (std::size_t agent = 0; agent < scenario.agents(); ++agent) sizes.push_back(scenario.observation_size(agent));
  return sizes;
}

TEST(Scenario, SimpleTagHasThreePredatorsAPreyAndTwoObstacles) {
  const auto scenario = Scenario::named("simple_tag");
  EXPECT_EQ(scenario.name, "simple_tag");
  EXPECT_EQ(scenario.episode_steps, 25U);
  EXPECT_EQ(scenario.agents(), 4U);
  EXPECT_EQ(scenario.predators(), 3U);
  EXPECT_EQ(scenario.prey(), 3U);
  EXPECT_EQ(scenario.landmarks(), 2U);
  EXPECT_EQ(scenario.count(Role::obstacle), 2U);
  EXPECT_EQ(observation_sizes(scenario), (std::vector<std::size_t>{16, 16, 16, 14}));
  EXPECT_EQ(scenario.observation_sizes(), 62U);
  EXPECT_EQ(scenario.entities[2].name, "agent2");
  EXPECT_EQ(scenario.entities[5].name, "landmark1");
}

TEST(Scenario, SimpleWorldHasFoodAndForestsToo) {
  const auto scenario = Scenario::named("simple_world", RewardRule::paper);
  EXPECT_EQ(scenario.rewards.rule, RewardRule::paper);
  EXPECT_EQ(Scenario::named("simple_world").rewards.rule, RewardRule::program);
  EXPECT_EQ(scenario.agents(), 4U);
  EXPECT_EQ(scenario.landmarks(), 5U);
  EXPECT_EQ(scenario.count(Role::obstacle), 1U);
  EXPECT_EQ(scenario.count(Role::food), 2U);
  EXPECT_EQ(scenario.count(Role::forest), 2U);
  EXPECT_EQ(observation_sizes(scenario), (std::vector<std::size_t>{24, 24, 24, 22}));
  EXPECT_EQ(scenario.observation_sizes(), 94U);
  EXPECT_EQ(scenario.entities[8].name, "forest1");
}

TEST(Scenario, AnyOtherNameIsRefusedWithTheNamesThereAre) {
  for (const char* name : {"", "simple_tags", "Simple_tag", "simple_world_comm"})
    expect_error<UsageError>([&] { Scenario::named(name); },
                             "scenario '" + std::string(name) + "': expected simple_tag or simple_world");
  expect_error<UsageError>([] { Scenario::named("a\nb" + std::string(1000, 'x')); }, "scenario 'a?bxx");
}

TEST(Scenario, NamesItsRewardRules) {
  EXPECT_EQ(to_string(RewardRule::program), "program");
  EXPECT_EQ(to_string(RewardRule::paper), "paper");
}

TEST(RequireSound, TakesWhatIsSound) {
  auto scenario = Scenario::named("simple_world");
  require_sound(scenario);
  scenario.physics.damping = 0;
  scenario.episode_steps = 1;
  scenario.entities.erase(scenario.entities.begin(), scenario.entities.begin() + 2);  // one predator
  scenario.entities.resize(2);                                                        // no landmark
  require_sound(scenario);
  while (scenario.entities.size() < most_entities) scenario.entities.push_back({"food", Role::food, 0.1, 0, 0});
  require_sound(scenario);
}

/// What is said of simple_world after `change`.
void expect_refusal(const std::function<void(Scenario&)>& change, const std::string& part) {
  auto scenario = Scenario::named("simple_world");
  change(scenario);
  expect_error<UsageError>([&] { require_sound(scenario); }, "scenario 'simple_world': " + part);
}

TEST(RequireSound, RefusesOtherCasts) {
  const std::string expected = "expected at least one predator, then one prey, then the landmarks";
  expect_refusal([](Scenario& s) { s.entities.clear(); }, expected);
  expect_refusal([](Scenario& s) { s.entities.erase(s.entities.begin(), s.entities.begin() + 3); }, expected);
  expect_refusal([](Scenario& s) { s.entities.erase(s.entities.begin() + 3); }, expected);
  expect_refusal([](Scenario& s) { s.entities.insert(s.entities.begin() + 3, s.entities[3]); }, expected);
  expect_refusal([](Scenario& s) { std::swap(s.entities[2], s.entities[3]); }, expected);
  expect_refusal([](Scenario& s) { std::swap(s.entities[3], s.entities[4]); }, expected);
  expect_refusal([](Scenario& s) { s.entities.push_back(s.entities[0]); }, expected);
  expect_refusal(
      [](Scenario& s) {
        while (s.entities.size() <= most_entities) s.entities.push_back(s.entities.back());
      },
      "more than 32 entities");
}

TEST(RequireSound, RefusesNumbersOutOfRange) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {0.0, -1.0, std::nan(""), infinity, 1e6}) {
    expect_refusal([&](Scenario& s) { s.entities[8].radius = bad; }, "forest1: radius, acceleration and top speed");
    expect_refusal([&](Scenario& s) { s.entities[0].radius = bad; }, "agent0: radius, acceleration and top speed");
    expect_refusal([&](Scenario& s) { s.entities[1].acceleration = bad; }, "agent1: radius");
    expect_refusal([&](Scenario& s) { s.entities[3].max_speed = bad; }, "agent3: radius");
    expect_refusal([&](Scenario& s) { s.physics.time_step = bad; }, "time step, contact force and margin");
    expect_refusal([&](Scenario& s) { s.physics.contact_force = bad; }, "time step, contact force and margin");
    expect_refusal([&](Scenario& s) { s.physics.contact_margin = bad; }, "time step, contact force and margin");
  }
  for (const double bad : {-0.1, 1.1, std::nan("")})
    expect_refusal([&](Scenario& s) { s.physics.damping = bad; }, "time step, contact force and margin");
  for (const double bad : {std::nan(""), infinity, -infinity, 1e6}) {
    expect_refusal([&](Scenario& s) { s.rewards.distance = bad; }, "weights of rewards");
    expect_refusal([&](Scenario& s) { s.rewards.catching = bad; }, "weights of rewards");
    expect_refusal([&](Scenario& s) { s.rewards.boundary = bad; }, "weights of rewards");
    expect_refusal([&](Scenario& s) { s.rewards.eating = bad; }, "weights of rewards");
    expect_refusal([&](Scenario& s) { s.rewards.food_distance = bad; }, "weights of rewards");
  }
  expect_refusal([](Scenario& s) { s.episode_steps = 0; }, "an episode has 1 to 1000000 steps");
  expect_refusal([](Scenario& s) { s.episode_steps = 1'000'001; }, "an episode has 1 to 1000000 steps");
  expect_refusal(
      [](Scenario& s) {
        s.entities[0].name = "two\nlines";
        s.entities[0].radius = 0;
      },
      "two?lines: radius");
}

TEST(BoundaryPenalty, HasItsKinks) {
  const double below_one = std::nextafter(1.0, 0);
  EXPECT_EQ(boundary_penalty(0), 0);
  EXPECT_EQ(boundary_penalty(std::nextafter(0.9, 0)), 0);
  EXPECT_EQ(boundary_penalty(0.9), 0);
  EXPECT_GT(boundary_penalty(std::nextafter(0.9, 1)), 0);
  EXPECT_NEAR(boundary_penalty(0.95), 0.5, 1e-14);
  EXPECT_EQ(boundary_penalty(below_one), 10 * (below_one - 0.9));
  EXPECT_EQ(boundary_penalty(1), 1);
  EXPECT_DOUBLE_EQ(boundary_penalty(1.5), std::exp(1.0));
  const double cap = 1 + std::log(10) / 2;
  EXPECT_NEAR(cap, 2.151, 5e-4);
  EXPECT_NEAR(boundary_penalty(cap - 1e-6), 10, 3e-5);
  EXPECT_LT(boundary_penalty(cap - 1e-6), 10);
  EXPECT_EQ(boundary_penalty(cap + 1e-6), 10);
  EXPECT_EQ(boundary_penalty(1e300), 10);
}

}  // namespace
}  // namespace folk::mpe
