#include <folk/games/error.h>
#include <folk/games/random.h>
#include <folk/mpe/players/scripted.h>
#include <folk/mpe/world/batch.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "games/expect_error.h"

namespace folk::mpe {
namespace {

using folk::test::expect_error;

const Layout& layout() {
  static const Layout layout(Scenario::named("simple_tag"));
  return layout;
}

/// A block of 64 episodes whose players are asked once; the state may be set beforehand.
class Question {
public:
  Question() { batch.reset(1); }

  /// What `controller` does with an agent in each lane.
  std::vector<Point> ask(const Controller& controller, std::size_t agent, const Moment& moment = {}) {
    const Block block = batch.block(0);
    controller.player(layout(), agent)->act(layout(), block, agent, moment);
    const auto [x, y] = action_rows(block, agent);
    std::vector<Point> actions;
    for (std::size_t lane = 0; lane < block_lanes; ++lane) actions.push_back({x[lane], y[lane]});
    return actions;
  }

  void set_positions(std::size_t agent, Point position) {
    for (std::size_t lane = 0; lane < block_lanes; ++lane) {
      auto state = batch.state(lane);
      state.positions[agent] = position;
      batch.set_state(lane, state);
    }
  }

  Batch batch{layout().scenario(), block_lanes};
};

/// Actions in many blocks and steps.
std::vector<Point> many(Question& question, const Controller& controller, std::size_t agent) {
  std::vector<Point> all;
  for (std::uint64_t block = 0; block < 8; ++block)
    for (std::size_t step = 0; step < 25; ++step) {
      const auto some = question.ask(controller, agent, {1, 64 * block, step});
      all.insert(all.end(), some.begin(), some.end());
    }
  return all;
}

/// Numbers uniform in [low, high], by their mean and ends.
void expect_uniform(const std::vector<double>& numbers, double low, double high) {
  double sum = 0;
  for (const double x : numbers) sum += x;
  const double n = static_cast<double>(numbers.size());
  EXPECT_NEAR(sum / n, (low + high) / 2, 4 * (high - low) / std::sqrt(12 * n));
  const auto [least, most] = std::minmax_element(numbers.begin(), numbers.end());
  EXPECT_GE(*least, low);
  EXPECT_LE(*most, high);
  EXPECT_LT(*least, low + 0.01 * (high - low));
  EXPECT_GT(*most, high - 0.01 * (high - low));
}

std::vector<double> axis(const std::vector<Point>& points, bool x) {
  std::vector<double> numbers;
  for (const Point& point : points) numbers.push_back(x ? point.x : point.y);
  return numbers;
}

// ---- still and random --------------------------------------------------------------------------------------------

TEST(StillPlayer, DoesNothing) {
  Question question;
  EXPECT_EQ(question.ask(still_player(), 1), std::vector<Point>(block_lanes));
  EXPECT_EQ(question.ask(still_player(), 3), std::vector<Point>(block_lanes));
  EXPECT_EQ(still_player().name, "still");
}

TEST(RandomPlayer, IsUniformWhereverItStands) {
  Question question;
  question.set_positions(3, {1.5, -2});
  const auto actions = many(question, random_player(), 3);
  expect_uniform(axis(actions, true), -1, 1);
  expect_uniform(axis(actions, false), -1, 1);
  EXPECT_EQ(random_player().name, "random");
}

TEST(RandomPlayer, IsAnotherInEachSeedEpisodeStepAgentAndAxis) {
  Question question;
  const auto here = question.ask(random_player(), 1, {1, 0, 0});
  EXPECT_NE(here[0].x, here[0].y);
  EXPECT_NE(here[0], here[1]);
  EXPECT_NE(here[0], question.ask(random_player(), 1, {2, 0, 0})[0]);
  EXPECT_NE(here[0], question.ask(random_player(), 1, {1, 0, 1})[0]);
  EXPECT_NE(here[0], question.ask(random_player(), 2, {1, 0, 0})[0]);
  EXPECT_NE(here[0], question.ask(random_player(), 3, {1, 0, 0})[0]);
  EXPECT_EQ(here[5], question.ask(random_player(), 1, {1, 5, 0})[0]);
}

TEST(RandomPlayer, OfTheProgramNeverGoesFurtherOut) {
  const auto rule = random_player(RandomRule::program);
  EXPECT_EQ(rule.name, "random(program)");
  Question question;
  question.set_positions(3, {1.5, -1.0001});
  auto actions = many(question, rule, 3);
  expect_uniform(axis(actions, true), -1, 0);
  expect_uniform(axis(actions, false), 0, 1);
  question.set_positions(3, {1, -1});  // the edge is inside
  actions = many(question, rule, 3);
  expect_uniform(axis(actions, true), -1, 1);
  expect_uniform(axis(actions, false), -1, 1);
  question.set_positions(3, {-7, 0.3});
  actions = many(question, rule, 3);
  expect_uniform(axis(actions, true), 0, 1);
  expect_uniform(axis(actions, false), -1, 1);
}

// ---- pursuit -----------------------------------------------------------------------------------------------------

TEST(Pursuit, FollowsItsFormula) {
  Question question;
  RandomStream random;
  for (std::size_t lane = 0; lane < block_lanes; ++lane) {
    auto state = question.batch.state(lane);
    for (auto& velocity : state.velocities) velocity = {random.uniform() - 0.5, random.uniform() - 0.5};
    if (lane % 2 == 0) state.positions[1] = {state.positions[3].x + 0.1 * random.uniform(), state.positions[3].y};
    question.batch.set_state(lane, state);
  }
  for (const std::size_t agent : {0, 1, 2}) {
    const auto lead = question.ask(lead_pursuit(), agent);
    const auto greedy = question.ask(greedy_pursuit(), agent);
    for (std::size_t lane = 0; lane < block_lanes; ++lane) {
      const auto [p, v] = question.batch.state(lane);
      const auto formula = [](double prey, double prey_v, double own, double own_v) {
        return std::clamp(3 * (prey + 0.2 * prey_v - own - 0.15 * own_v), -1.0, 1.0);
      };
      EXPECT_NEAR(lead[lane].x, formula(p[3].x, v[3].x, p[agent].x, v[agent].x), 1e-14);
      EXPECT_NEAR(lead[lane].y, formula(p[3].y, v[3].y, p[agent].y, v[agent].y), 1e-14);
      EXPECT_EQ(greedy[lane].x, std::clamp(3 * (p[3].x - p[agent].x), -1.0, 1.0));
      EXPECT_EQ(greedy[lane].y, std::clamp(3 * (p[3].y - p[agent].y), -1.0, 1.0));
    }
  }
  EXPECT_EQ(lead_pursuit().name, "lead_pursuit");
  EXPECT_EQ(greedy_pursuit().name, "greedy_pursuit");
}

TEST(Pursuit, IsNotForThePrey) {
  for (const auto& pursuit : {lead_pursuit(), greedy_pursuit()})
    expect_error<UsageError>([&] { pursuit.player(layout(), 3); }, "pursuit is for predators");
}

// ---- blend -------------------------------------------------------------------------------------------------------

/// Which of a block's lanes were left to the still player.
std::vector<bool> coins(Question& question, const Controller& blend, std::size_t agent, const Moment& moment) {
  std::vector<bool> coins;
  for (const Point& action : question.ask(blend, agent, moment)) coins.push_back(action == Point{});
  return coins;
}

TEST(Blend, TossesACoinForEachEpisodeStepAndAgent) {
  Question question;
  for (const double p : {0.0, 0.25, 0.5, 0.9, 1.0}) {
    const auto player = blend(p, still_player());
    double heads = 0;
    double count = 0;
    std::set<std::vector<bool>> seen;
    for (const std::size_t agent : {0, 2, 3})
      for (std::uint64_t first = 0; first < 512; first += 64)
        for (std::size_t step = 0; step < 25; ++step) {
          const auto tosses = coins(question, player, agent, {1, first, step});
          seen.insert(tosses);
          heads += static_cast<double>(std::count(tosses.begin(), tosses.end(), true));
          count += 64;
        }
    EXPECT_NEAR(heads / count, p, 4 * std::sqrt(p * (1 - p) / count));
    if (p == 0 || p == 1)
      EXPECT_EQ(seen.size(), 1U);
    else
      EXPECT_GT(seen.size(), 590U) << p;  // of 600; a few may be alike
  }
}

TEST(Blend, SharesOneCoinBetweenTheEpisodesOfASeed) {
  Question question;
  for (const double p : {0.25, 0.5}) {
    const auto player = blend(p, still_player(), Coin::batch);
    double heads = 0;
    double count = 0;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
      std::vector<bool> of_first_block;
      for (const std::uint64_t first : {0, 640})
        for (std::size_t step = 0; step < 25; ++step) {
          const auto tosses = coins(question, player, 3, {seed, first, step});
          ASSERT_EQ(std::set<bool>(tosses.begin(), tosses.end()).size(), 1U);
          if (first == 0)
            of_first_block.push_back(tosses[0]);
          else
            ASSERT_EQ(of_first_block[step], tosses[0]);
        }
      heads += static_cast<double>(std::count(of_first_block.begin(), of_first_block.end(), true));
      count += 25;
    }
    EXPECT_NEAR(heads / count, p, 4 * std::sqrt(p * (1 - p) / count));
  }
}

TEST(Blend, OtherwiseIsUniform) {
  Question question;
  std::vector<Point> others;
  for (const Point& action : many(question, blend(0.5, still_player()), 3))
    if (action != Point{}) others.push_back(action);
  for (const Point& action : others) EXPECT_NE(action.x, action.y);
  expect_uniform(axis(others, true), -1, 1);
  expect_uniform(axis(others, false), -1, 1);
}

TEST(Blend, PlaysTheOneItWasGiven) {
  Question question;
  EXPECT_EQ(question.ask(blend(1, lead_pursuit()), 1), question.ask(lead_pursuit(), 1));
  EXPECT_NE(question.ask(blend(0, lead_pursuit()), 1), question.ask(lead_pursuit(), 1));
  expect_error<UsageError>([] { blend(0.5, lead_pursuit()).player(layout(), 3); }, "pursuit is for predators");
}

TEST(Blend, TellsTheOneOfEachStartAndSaysWhatItIs) {
  struct Counting final : Player {
    explicit Counting(int& starts)
        : starts_(starts) {}
    void start(const Layout&, const Block&, std::size_t, const Moment&) override { ++starts_; }
    void act(const Layout&, const Block&, std::size_t, const Moment&) override {}
    int& starts_;
  };
  int starts = 0;
  const Controller one{"one", each([&](const Layout&, std::size_t) { return std::make_unique<Counting>(starts); }),
                       true};
  const auto player = blend(0.25, one).player(layout(), 3);
  Question question;
  for (int i = 0; i < 3; ++i) player->start(layout(), question.batch.block(0), 3, {});
  EXPECT_EQ(starts, 3);
  EXPECT_TRUE(blend(0.25, one).one_by_one);
  EXPECT_FALSE(blend(0.25, still_player()).one_by_one);
  EXPECT_EQ(blend(0.25, one).name, "blend(0.25;one)");
  EXPECT_EQ(blend(1, one, Coin::batch).name, "blend(1;one;shared)");
}

TEST(Blend, RefusesWhatIsNoProbability) {
  for (const double p : {-0.01, 1.5, std::nan(""), HUGE_VAL})
    expect_error<UsageError>([&] { blend(p, still_player()); }, "expected a probability from 0 to 1");
}

// Both would toss the same coin.
TEST(Blend, RefusesABlendOfABlend) {
  expect_error<UsageError>([] { blend(0.5, blend(0.5, still_player())); },
                           "blend(0.5;blend(0.5;still)): a blend of a blend");
}

TEST(Sides, ThePreyIsTheLastAgent) {
  EXPECT_EQ(side_of(layout(), 0), Side::predators);
  EXPECT_EQ(side_of(layout(), 2), Side::predators);
  EXPECT_EQ(side_of(layout(), 3), Side::prey);
  const Cast cast{lead_pursuit(), still_player()};
  EXPECT_EQ(cast.of(layout(), 2).name, "lead_pursuit");
  EXPECT_EQ(cast.of(layout(), 3).name, "still");
  EXPECT_FALSE(cast.one_by_one());
  auto alone = still_player();
  alone.one_by_one = true;
  EXPECT_TRUE((Cast{lead_pursuit(), alone}).one_by_one());
  EXPECT_TRUE((Cast{alone, still_player()}).one_by_one());
}

}  // namespace
}  // namespace folk::mpe
