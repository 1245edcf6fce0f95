// Plans on beliefs: of players whose beliefs are a machine's, beside a search on that machine; and of real planners.

#include <analysis/beliefs/believing_player.h>
#include <folk/analysis/beliefs/planned_belief_gap.h>
#include <folk/analysis/replies/bayes_player.h>
#include <folk/games/error.h>
#include <folk/games/progress.h>
#include <games/expect_error.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace folk {
namespace {

using test::believer;
using test::expect_error;
using test::paths;

constexpr std::array dilemma{3.0, 0.0, 5.0, 1.0};

/// What the next `depth` rounds are worth against a machine in a state, by the first move.
std::array<double, 2> worth(const Machine& model, State state, std::size_t depth) {
  std::array<double, 2> values{};
  const double c = model.cooperation(state);
  for (const Outcome outcome : all_outcomes) {
    const double p = outcome.theirs == Move::C ? c : 1 - c;
    double& value = values[bit(outcome.own)];
    value += p * dilemma[outcome.index()];
    if (depth == 1 || p == 0) continue;
    const auto after = worth(model, model.next(state, outcome.theirs, outcome.own), depth - 1);
    value += p * std::max(after[0], after[1]);
  }
  return values;
}

TEST(PlannedBeliefGap, EqualsASearchOnTheMachineThatIsBelievedIn) {
  const auto registry = Registry::standard();
  double largest = 0;
  for (const char* own : {"tit_for_tat", "all_d", "per_ccd", "spiteful"})
    for (const char* name : {"gtft(0.3)", "random(0.6)", "pavlov", "mem1(0.7;0.9,0.2,0.4,0.1)"})
      for (const bool clones : {true, false}) {
        const auto player = believer(own, name, clones);
        const auto model = registry.make(name).machine;
        for (const std::size_t depth : {1U, 2U, 4U})
          for (const auto& path : paths(player, "tit_for_tat,all_d,pavlov", 9)) {
            double most = 0;
            std::uint64_t round = 0;
            State state = model->start();
            for (std::uint64_t t = 0; t < path.size(); ++t) {
              const auto values = worth(*model, state, std::min<std::size_t>(depth, path.size() - t));
              const double gain = values[bit(other(path[t].own))] - values[bit(path[t].own)];
              if (gain > most + 1e-9) most = gain, round = t + 1;
              state = model->next(state, path[t].theirs, path[t].own);
            }
            const auto found =
                planned_belief_gaps(player, {path}, {.depth = depth, .least_probability = 0}).front().value();
            EXPECT_NEAR(found.gain, most, 1e-3) << player.name << " depth " << depth;
            if (most > 1e-3) {
              EXPECT_EQ(found.round, round);
              EXPECT_NEAR(found.best_value - found.own_value, found.gain, 1e-12);
              EXPECT_EQ(found.own_moves.size(), 1U);
            }
            EXPECT_EQ(found.searched_rounds, path.size());
            largest = std::max(largest, most);
          }
      }
  EXPECT_GT(largest, 3);
}

TEST(PlannedBeliefGap, IsZeroForWhoPlansSoFar) {
  Registry registry = Registry::standard();
  add_bayes(registry);
  for (const char* name : {"bayes(classics;depth=3)", "bayes(3*classics,memory(1,1);depth=3;slip=0.01)"}) {
    const auto planner = registry.make(name);
    EXPECT_EQ(planner.plans_ahead, 3U);
    const auto played = paths(planner, "classics,mem12_ccCDCDDCDD", 20);
    const auto gaps = planned_belief_gaps(planner, played, {.threads = 2, .depth = 3, .least_probability = 0});
    for (std::size_t i = 0; i < gaps.size(); ++i) {
      // Once nobody of the roster is possible it holds 0.5 and repeats what it saw.
      if (played[i].back().belief == 0.5) continue;
      EXPECT_EQ(gaps[i]->gain, 0) << name << " against number " << i << " in round " << gaps[i]->round;
    }
  }
  // Who looks one round ahead defects; who looks further sees what comes of it.
  const auto hasty = registry.make("bayes(classics;depth=1)");
  const auto played = paths(hasty, "tit_for_tat", 20);
  EXPECT_EQ(planned_belief_gaps(hasty, played, {.depth = 1}).front()->gain, 0);
  EXPECT_GT(planned_belief_gaps(hasty, played, {.depth = 3}).front()->gain, 1);
}

/// In round 9 of 10 cooperation earns 0 + 5 of a tit_for_tat that defects, instead of 1 + 1; before it 0 + 3 + 5
/// instead of 1 + 0 + 5.
TEST(PlannedBeliefGap, IsOfTheAskedRounds) {
  const auto player = believer("all_d", "tit_for_tat");
  const auto played = paths(player, "tit_for_tat", 10);
  EXPECT_EQ(planned_belief_gaps(player, played, {.depth = 3}).front()->round, 9U);
  EXPECT_EQ(planned_belief_gaps(player, played, {.depth = 3}).front()->gain, 3);
  const auto later = planned_belief_gaps(player, played, {.depth = 3, .rounds = {7, 5}}).front().value();
  EXPECT_EQ(later.searched_rounds, 2U);
  EXPECT_EQ(later.round, 5U);
}

TEST(PlannedBeliefGap, AsksTheBelieversWhereThereAreSome) {
  auto player = believer("all_d", "tit_for_tat");
  const auto played = paths(player, "tit_for_tat", 6);
  player.make_believer = believer("all_c", "tit_for_tat").make_player;
  player.make_player = nullptr;
  EXPECT_GT(planned_belief_gaps(player, played, {.depth = 3}).front()->gain, 0);
}

TEST(PlannedBeliefGap, IsNothingWithoutBeliefsOrWithChance) {
  auto player = believer("all_d", "tit_for_tat");
  const auto played = paths(player, "tit_for_tat", 6);
  player.deterministic = false;
  EXPECT_FALSE(planned_belief_gaps(player, played, {}).front());
  EXPECT_FALSE(planned_belief_gaps(Registry::standard().make("all_d"), played, {}).front());
  EXPECT_TRUE(planned_belief_gaps(player, {}, {}).empty());
}

TEST(PlannedBeliefGap, Refuses) {
  const auto player = believer("all_d", "tit_for_tat");
  const auto played = paths(player, "tit_for_tat", 6);
  expect_error<UsageError>([&] { planned_belief_gaps(player, played, {.depth = 0}); }, "expected 1 to 10");
  expect_error<UsageError>([&] { planned_belief_gaps(player, played, {.depth = 11}); }, "expected 1 to 10");
  expect_error<UsageError>([&] { planned_belief_gaps(player, played, {.rounds = {7}}); }, "round 7 of a path of 6");
  EXPECT_THROW(planned_belief_gaps(player, {played[0], paths(player, "all_d", 5)[0]}, {}), UsageError);
  const Progress stopped;
  stopped.cancel();
  EXPECT_THROW(planned_belief_gaps(player, played, {}, stopped), Cancelled);
}

}  // namespace
}  // namespace folk
