// One step of the world: held against the slow one, and at the points where its rules have an edge.

#include <folk/games/error.h>
#include <folk/games/random.h>
#include <folk/mpe/world/batch.h>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "mpe/world/naive_world.h"
#include "mpe/world/random_states.h"

namespace folk::mpe {
namespace {

using testing::NaiveWorld;

/// Each scenario with each reward rule.
struct Case {
  Scenario scenario;
  NaiveWorld naive;
};

std::vector<Case> cases() {
  std::vector<Case> cases;
  for (const auto rule : {RewardRule::program, RewardRule::paper}) {
    cases.push_back({Scenario::named("simple_tag", rule), NaiveWorld::simple_tag()});
    cases.push_back({Scenario::named("simple_world", rule), NaiveWorld::simple_world()});
    for (std::size_t i = cases.size() - 2; i < cases.size(); ++i) cases[i].naive.paper = rule == RewardRule::paper;
  }
  return cases;
}

void set_actions(Batch& batch, std::size_t episode, const std::vector<Point>& actions) {
  for (std::size_t agent = 0; agent < actions.size(); ++agent) batch.set_action(episode, agent, actions[agent]);
}

/// The largest difference between an episode and the slow world, in state, observations and rewards.
double difference(const Batch& batch, std::size_t episode, const NaiveWorld& naive) {
  double worst = 0;
  const auto compare = [&](double ours, double theirs) {
    const double here = std::abs(ours - theirs);
    worst = here <= worst ? worst : here;  // NaN too is a difference
  };
  const auto state = batch.state(episode);
  for (std::size_t i = 0; i < naive.bodies.size(); ++i) {
    compare(state.positions[i].x, naive.bodies[i].x);
    compare(state.positions[i].y, naive.bodies[i].y);
    if (i >= naive.agents()) continue;
    compare(state.velocities[i].x, naive.bodies[i].vx);
    compare(state.velocities[i].y, naive.bodies[i].vy);
    const auto ours = batch.observation(episode, i);
    const auto theirs = naive.observation(i);
    if (ours.size() != theirs.size()) return INFINITY;
    for (std::size_t k = 0; k < ours.size(); ++k) compare(ours[k], theirs[k]);
    compare(batch.reward(episode, i), naive.reward(i));
  }
  return worst;
}

// From resets on, wherever 25 random steps lead, one step at a time.
TEST(Step, IsThatOfTheSlowWorldInThousandsOfSteps) {
  for (auto& [scenario, naive] : cases()) {
    Batch batch(scenario, 150);
    batch.reset(11);
    RandomStream random({.seed = 12});
    double worst = 0;
    for (int t = 0; t < 25; ++t) {
      std::vector<EpisodeState> before;
      std::vector<std::vector<Point>> actions;
      for (std::size_t e = 0; e < batch.size(); ++e) {
        before.push_back(batch.state(e));
        const double size = e % 3 == 0 ? 10 : e % 3 == 1 ? 1 : 0.1;
        auto& chosen = actions.emplace_back();
        for (std::size_t i = 0; i < scenario.agents(); ++i)
          chosen.push_back({size * (2 * random.uniform() - 1), size * (2 * random.uniform() - 1)});
        set_actions(batch, e, chosen);
      }
      batch.step();
      for (std::size_t e = 0; e < batch.size(); ++e) {
        naive.place(before[e]);
        naive.step(actions[e]);
        worst = std::max(worst, difference(batch, e, naive));
      }
    }
    EXPECT_LE(worst, 1e-12) << scenario.name;
  }
}

RC_GTEST_PROP(Step, IsThatOfTheSlowWorldFromAnywhere, ()) {
  const auto all = cases();
  auto [scenario, naive] = all[*rc::gen::inRange<std::size_t>(0, all.size())];
  const auto state = *testing::any_state(scenario);
  const auto actions = *testing::any_actions(scenario);
  Batch batch(scenario, 1);
  batch.set_state(0, state);
  set_actions(batch, 0, actions);
  naive.place(state);
  for (int t = 0; t < 3; ++t) {
    batch.step();
    naive.step(actions);
    RC_ASSERT(difference(batch, 0, naive) <= 1e-12);
    naive.place(batch.state(0));
  }
}

// Other sizes, and a soft or hard wall: so hard that exp(-depth) is below every double.
RC_GTEST_PROP(Step, IsThatOfTheSlowWorldInScenariosOfOnesOwn, ()) {
  auto scenario = Scenario::named("simple_world");
  auto naive = NaiveWorld::simple_world();
  naive.margin = scenario.physics.contact_margin = *rc::gen::element(1e-5, 1e-4, 3e-2);
  for (std::size_t i = 0; i < naive.bodies.size(); ++i)
    naive.bodies[i].radius = scenario.entities[i].radius = *rc::gen::inRange(1, 60) * 0.0173;
  const auto state = *testing::any_state(scenario);
  const auto actions = *testing::any_actions(scenario);
  Batch batch(scenario, 1);
  batch.set_state(0, state);
  set_actions(batch, 0, actions);
  batch.step();
  naive.place(state);
  naive.step(actions);
  RC_ASSERT(difference(batch, 0, naive) <= 1e-11);
}

RC_GTEST_PROP(Step, IsFiniteFromAnywhere, ()) {
  const auto all = cases();
  const auto& scenario = all[*rc::gen::inRange<std::size_t>(0, all.size())].scenario;
  const double size = *rc::gen::element(1.0, 1e-200, 1e50, 1e100 / 30);
  const auto scaled = [&](std::vector<Point> points) {
    for (auto& point : points) point = {point.x * size, point.y * size};
    return points;
  };
  auto state = *testing::any_state(scenario);
  state = {scaled(state.positions), scaled(state.velocities)};
  Batch batch(scenario, 1);
  batch.set_state(0, state);
  set_actions(batch, 0, scaled(*testing::any_actions(scenario)));
  for (int t = 0; t < 5; ++t) {
    batch.step();
    for (std::size_t agent = 0; agent < scenario.agents(); ++agent) {
      const auto [vx, vy] = batch.state(0).velocities[agent];
      RC_ASSERT(std::sqrt(vx * vx + vy * vy) <= scenario.entities[agent].max_speed * (1 + 1e-15));
      for (const double number : batch.observation(0, agent)) RC_ASSERT(std::isfinite(number));
      RC_ASSERT(std::isfinite(batch.reward(0, agent)));
    }
  }
}

/// Everybody far from everybody, at rest, in a batch of one.
class Alone {
public:
  explicit Alone(const Scenario& scenario)
      : batch(scenario, 1) {
    state = batch.state(0);
    for (std::size_t i = 0; i < state.positions.size(); ++i) state.positions[i] = {100.0 * static_cast<double>(i), 50};
  }

  void step(const std::vector<Point>& actions = std::vector<Point>(4)) {
    batch.set_state(0, state);
    set_actions(batch, 0, actions);
    batch.step();
  }

  Batch batch;
  EpisodeState state;
};

TEST(Step, AForceIsTheAccelerationSquaredTimesTheAction) {
  Alone world(Scenario::named("simple_tag"));
  world.state.velocities[1] = {0.1, -0.2};
  world.step({{0.1, -0.05}, {0, 0}, {0, 0}, {-0.05, 0.02}});
  const auto after = world.batch.state(0);
  EXPECT_NEAR(after.velocities[0].x, 0.09, 1e-15);
  EXPECT_NEAR(after.velocities[0].y, -0.045, 1e-15);
  EXPECT_NEAR(after.positions[0].x, 0.009, 1e-15);
  EXPECT_NEAR(after.velocities[1].x, 0.075, 1e-15);
  EXPECT_NEAR(after.velocities[1].y, -0.15, 1e-15);
  EXPECT_NEAR(after.positions[1].y, 50 - 0.015, 1e-14);
  EXPECT_EQ(after.positions[2], world.state.positions[2]);
  EXPECT_NEAR(after.velocities[3].x, -0.08, 1e-15);
  EXPECT_NEAR(after.velocities[3].y, 0.032, 1e-15);
  EXPECT_EQ(after.positions[4], world.state.positions[4]);
}

TEST(Step, SpeedsAreCutToTheTop) {
  Alone world(Scenario::named("simple_tag"));
  world.step({{1.111, 0}, {1.12, 0}, {-3, 4}, {0, -9}});
  const auto after = world.batch.state(0);
  EXPECT_NEAR(after.velocities[0].x, 0.9999, 1e-15);  // not quite
  EXPECT_EQ(after.velocities[1].x, 1.0);
  EXPECT_NEAR(after.positions[1].x, 100.1, 1e-13);
  EXPECT_NEAR(after.velocities[2].x, -0.6, 1e-15);
  EXPECT_NEAR(after.velocities[2].y, 0.8, 1e-15);
  EXPECT_EQ(after.velocities[3].y, -1.3);
}

// The program yields NaN there; here it is no force at all, and all others act as ever.
TEST(Step, TwoInOnePointDoNotPush) {
  Alone world(Scenario::named("simple_tag"));
  world.state.positions[0] = world.state.positions[1] = world.state.positions[4] = {0.3, -0.2};
  world.state.positions[3] = {0.4, -0.2};
  world.step();
  const auto after = world.batch.state(0);
  EXPECT_LT(after.velocities[0].x, 0);  // away from the prey
  EXPECT_EQ(after.velocities[0].y, 0);
  EXPECT_EQ(after.velocities[0], after.velocities[1]);
  EXPECT_GT(after.velocities[3].x, 0);
  world.state.positions[3] = {100, 100};
  world.step();
  EXPECT_EQ(world.batch.state(0).velocities, std::vector<Point>(4));
  EXPECT_EQ(world.batch.state(0).positions, world.state.positions);
}

// Pushing is mutual, landmarks stay, and food and forests push nobody.
TEST(Step, WhoCollidesWithWhom) {
  const auto scenario = Scenario::named("simple_world");
  Alone world(scenario);
  for (std::size_t a = 0; a < 4; ++a)
    for (std::size_t b = a + 1; b < 9; ++b) {
      const auto before = world.state;
      world.state.positions[a] = {0, 0};
      world.state.positions[b] = {0, 0.04};
      world.step();
      const auto after = world.batch.state(0);
      const bool pushed = b <= 4;  // agents and the obstacle
      EXPECT_EQ(after.velocities[a].y < 0, pushed) << a << " " << b;
      EXPECT_EQ(after.velocities[a].x, 0);
      if (b < 4)
        EXPECT_EQ(after.velocities[b].y, -after.velocities[a].y) << a << " " << b;
      else
        EXPECT_EQ(after.positions[b], world.state.positions[b]);
      world.state = before;
    }
}

// A predator sees its velocity and place, landmarks and others from where it is, the prey's velocity, forests.
TEST(Observation, IsInTheOrderOfTheProgram) {
  for (const char* name : {"simple_tag", "simple_world"}) {
    const auto scenario = Scenario::named(name);
    Batch batch(scenario, 1);
    auto state = batch.state(0);
    for (std::size_t i = 0; i < state.positions.size(); ++i)
      state.positions[i] = {static_cast<double>(i), 10 + 2 * static_cast<double>(i)};
    for (std::size_t i = 0; i < 4; ++i)
      state.velocities[i] = {0.125 * static_cast<double>(i), -0.25 * static_cast<double>(i)};
    state.positions.back() = {1.25, 12};  // the last forest stands around agent 1
    batch.set_state(0, state);
    const bool forests = scenario.count(Role::forest) > 0;
    const std::vector<double> of_predator_1 =
        forests ? std::vector<double>{0.125, -0.25, 1,  12, 3, 6, 4, 8, 5,     10,    6,  12,
                                      0.25,  0,     -1, -2, 1, 2, 2, 4, 0.375, -0.75, -1, 1}
                : std::vector<double>{0.125, -0.25, 1, 12, 3, 6, 0.25, 0, -1, -2, 1, 2, 2, 4, 0.375, -0.75};
    const std::vector<double> of_prey =
        forests ? std::vector<double>{0.375, -0.75, 3,  16, 1,  2,  2,  4,  3,  6,  4,
                                      8,     -1.75, -4, -3, -6, -2, -4, -1, -2, -1, -1}
                : std::vector<double>{0.375, -0.75, 3, 16, 1, 2, -1.75, -4, -3, -6, -2, -4, -1, -2};
    EXPECT_EQ(batch.observation(0, 1), of_predator_1) << name;
    EXPECT_EQ(batch.observation(0, 3), of_prey) << name;
  }
}

TEST(Observation, SomebodyAtTheEdgeOfAForestIsOutside) {
  const auto scenario = Scenario::named("simple_world");
  Alone world(scenario);
  for (std::size_t agent = 0; agent < 4; ++agent) {
    const double edge = scenario.entities[agent].radius + scenario.entities[7].radius;
    for (const std::size_t forest : {std::size_t{7}, std::size_t{8}}) {
      const auto flag = [&](double x, double y) {
        auto state = world.state;
        state.positions[forest] = {0, 0};
        state.positions[agent] = {x, y};
        world.batch.set_state(0, state);
        const auto seen = world.batch.observation(0, agent);
        EXPECT_EQ(seen[seen.size() - (forest == 7 ? 1 : 2)], -1);
        return seen[seen.size() - (forest == 7 ? 2 : 1)];
      };
      EXPECT_EQ(flag(edge, 0), -1);
      EXPECT_EQ(flag(std::nextafter(edge, 0), 0), 1);
      EXPECT_EQ(flag(0, -edge), -1);
      EXPECT_EQ(flag(0, std::nextafter(-edge, 0)), 1);
      EXPECT_EQ(flag(0, 0), 1);
    }
  }
}

/// Scenarios in which nobody pushes hard enough to move anybody, so that places after a step are known to the last bit.
Scenario without_contact(const char* name) {
  auto scenario = Scenario::named(name);
  scenario.physics.contact_force = 1e-300;
  return scenario;
}

TEST(Reward, ThePreyAtTheEdgeIsNotCaught) {
  for (const char* name : {"simple_tag", "simple_world"}) {
    auto scenario = without_contact(name);
    scenario.rewards.distance = 0;
    scenario.rewards.food_distance = 0;
    const double each = name == std::string("simple_tag") ? 10 : 5;
    Alone world(scenario);
    world.state.positions[3] = {0, 0};
    for (std::size_t agent = 0; agent < 3; ++agent) {
      const double edge = scenario.entities[agent].radius + scenario.entities[3].radius;
      const auto before = world.state;
      world.state.positions[agent] = {edge, 0};
      world.step();
      EXPECT_EQ(world.batch.reward(0, 0), 0);
      world.state.positions[agent] = {std::nextafter(edge, 0), 0};
      world.step();
      for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(world.batch.reward(0, i), each);
      EXPECT_EQ(world.batch.reward(0, 3), -each);
      world.state = before;
    }
    for (std::size_t agent = 0; agent < 3; ++agent) world.state.positions[agent] = {0.01, 0.01};
    world.step();
    EXPECT_EQ(world.batch.reward(0, 2), 3 * each);
    EXPECT_EQ(world.batch.reward(0, 3), -3 * each);
  }
}

TEST(Reward, ThePaperCountsDistancesOnlyWhereNobodyTouches) {
  auto scenario = without_contact("simple_tag");
  scenario.rewards.rule = RewardRule::paper;
  Alone world(scenario);
  for (std::size_t i = 0; i < 4; ++i) world.state.positions[i] = {0.2 * static_cast<double>(i), 0};
  world.step();
  EXPECT_NEAR(world.batch.reward(0, 0), -0.12, 1e-15);
  EXPECT_NEAR(world.batch.reward(0, 3), 0.12, 1e-15);
  world.state.positions[1] = {0.6, 0};
  world.step();
  EXPECT_EQ(world.batch.reward(0, 0), 10);
  EXPECT_NEAR(world.batch.reward(0, 3), 0.08 - 10, 1e-14);  // the text takes nothing from the prey
}

TEST(Reward, TheProgramAlwaysCountsDistances) {
  Alone world(without_contact("simple_tag"));
  for (std::size_t i = 0; i < 4; ++i) world.state.positions[i] = {0.2 * static_cast<double>(i), 0};
  world.state.positions[1] = {0.6, 0};
  world.step();
  EXPECT_NEAR(world.batch.reward(0, 0), 10 - 0.08, 1e-15);
  EXPECT_NEAR(world.batch.reward(0, 3), -10 + 0.08, 1e-15);
}

TEST(Reward, FoodIsEatenAndItsDistanceIsPaidFor) {
  auto scenario = without_contact("simple_world");
  scenario.rewards.distance = 0;
  Alone world(scenario);
  world.state.positions[3] = {0, 0};
  const double edge = scenario.entities[3].radius + scenario.entities[5].radius;
  world.state.positions[5] = {0, 0.5};
  world.state.positions[6] = {0.4, 0};
  world.step();
  EXPECT_EQ(world.batch.reward(0, 3), 0.05 * 0.4);
  EXPECT_EQ(world.batch.reward(0, 0), 0);
  world.state.positions[5] = {0, edge};
  world.step();
  EXPECT_EQ(world.batch.reward(0, 3), 0.05 * edge);
  world.state.positions[5] = {0, std::nextafter(edge, 0)};
  world.step();
  EXPECT_NEAR(world.batch.reward(0, 3), 2 + 0.05 * edge, 1e-15);
  world.state.positions[6] = {0.01, 0};
  world.step();
  EXPECT_NEAR(world.batch.reward(0, 3), 4 + 0.0005, 1e-15);
}

TEST(Reward, TheBoundaryPenaltyHasItsKinks) {
  const double cap = 1 + std::log(10) / 2;
  for (const char* name : {"simple_tag", "simple_world"}) {
    auto scenario = without_contact(name);
    scenario.rewards.distance = 0;
    scenario.rewards.food_distance = 0;
    const double weight = name == std::string("simple_tag") ? 1 : 2;
    Alone world(scenario);
    for (std::size_t i = 0; i < world.state.positions.size(); ++i) world.state.positions[i] = {500, 500};
    for (const double x : {0.0, std::nextafter(0.9, 0), 0.9, std::nextafter(0.9, 1), 0.95, std::nextafter(1.0, 0), 1.0,
                           std::nextafter(1.0, 2), 1.5, cap - 1e-6, cap, cap + 1e-6, 3.0, 400.0, 1e99})
      for (const double sign : {1.0, -1.0})
        for (const bool on_x : {true, false}) {
          world.state.positions[3] = on_x ? Point{sign * x, 0} : Point{0, sign * x};
          world.step();
          EXPECT_DOUBLE_EQ(world.batch.reward(0, 3), -weight * boundary_penalty(x)) << x;
          if (x <= 1) {
            EXPECT_EQ(world.batch.reward(0, 3), -weight * boundary_penalty(x)) << x;
          }
          EXPECT_EQ(world.batch.reward(0, 0), 0);
        }
    world.state.positions[3] = {-1.5, 0.95};
    world.step();
    EXPECT_NEAR(world.batch.reward(0, 3), -weight * (std::exp(1) + 0.5), 1e-14);
  }
}

TEST(Block, StoresTheSameThroughTheCachesAndPastThem) {
  for (const char* name : {"simple_tag", "simple_world"}) {
    Batch one(Scenario::named(name), 64);
    Batch other(Scenario::named(name), 64);
    for (Batch* batch : {&one, &other}) {
      batch->reset(5);
      set_actions(*batch, 7, {{1, 0}, {0, 1}, {-1, 0}, {0.5, 0.5}});
    }
    const Block cached = one.block(0);
    const Block past = other.block(0);
    for (int t = 0; t < 10; ++t) {
      step(one.layout(), cached, Stores::cached);
      step(other.layout(), past, Stores::past_caches);
    }
    const auto same = [](const double* a, const double* b, std::size_t rows) {
      return std::equal(a, a + rows * block_lanes, b);
    };
    EXPECT_TRUE(same(cached.state, past.state, one.layout().state_rows()));
    EXPECT_TRUE(same(cached.observations, past.observations, one.layout().observation_rows()));
    EXPECT_TRUE(same(cached.rewards, past.rewards, one.layout().reward_rows()));
  }
}

TEST(Layout, CountsItsRows) {
  const Layout layout(Scenario::named("simple_world"));
  EXPECT_EQ(layout.state_rows(), 4U * 4 + 2 * 5);
  EXPECT_EQ(layout.action_rows(), 8U);
  EXPECT_EQ(layout.observation_rows(), 94U);
  EXPECT_EQ(layout.reward_rows(), 4U);
  EXPECT_EQ(layout.position_row(3), 12U);
  EXPECT_EQ(layout.position_row(4), 16U);
  EXPECT_EQ(layout.position_row(8), 24U);
  EXPECT_EQ(layout.observation_begin(0), 0U);
  EXPECT_EQ(layout.observation_begin(3), 72U);
  EXPECT_EQ(layout.food(), (std::vector<std::size_t>{5, 6}));
  EXPECT_EQ(layout.forests(), (std::vector<std::size_t>{7, 8}));
  EXPECT_EQ(layout.pairs().size(), 6U + 4);
  auto unsound = Scenario::named("simple_tag");
  unsound.entities.clear();
  EXPECT_THROW(Layout{unsound}, UsageError);
}

}  // namespace
}  // namespace folk::mpe
