// What a planner finds against the same search with a Thinker of its own in every situation.

#include <folk/games/outcome.h>
#include <folk/sct/policy/planner.h>
#include <games/expect_error.h>
#include <gtest/gtest.h>
#include <sct/policy/playing_policy.h>

#include <algorithm>
#include <array>
#include <tuple>

namespace folk::sct {
namespace {

constexpr std::array<double, 4> dilemma{3, 0, 5, 1};

void play_on(const Mind& mind, MatchSoFar& so_far, const Outcome& played) {
  add_round(so_far, played.own, played.theirs, Move::C, mind.return_token(dilemma[played.index()]));
}

/// Planner::plan word by word: the match is played on in every way, and thought through anew.
std::array<double, 2> searched(const Mind& mind, const MatchSoFar& so_far, const PlanSettings& settings,
                               unsigned depth) {
  Thinker thinker(mind);
  const double belief = thinker.believe(so_far);
  std::array<double, 2> values{};
  for (std::size_t own = 0; own < 2; ++own) {
    double followed = 0, later = 0;
    for (std::size_t theirs = 0; theirs < 2; ++theirs) {
      const double probability = theirs == 0 ? belief : 1 - belief;
      const Outcome played = all_outcomes[2 * own + theirs];
      values[own] += probability * dilemma[played.index()];
      if (depth == 1 || probability < settings.least_probability) continue;
      MatchSoFar next = so_far;
      play_on(mind, next, played);
      const auto [c, d] = searched(mind, next, settings, depth - 1);
      followed += probability;
      later += probability * std::max(c, d);
    }
    if (followed > 0) values[own] += settings.continuation * later / followed;
  }
  return values;
}

class PlannerTest : public ::testing::TestWithParam<std::tuple<LossMode, Readout, std::size_t>> {
protected:
  static Mind mind() {
    Policy policy =
        test::playing_policy({"", std::get<0>(GetParam()), std::get<1>(GetParam()), true, std::get<2>(GetParam())});
    policy.training.shows_return = std::get<2>(GetParam()) != 7;
    return Mind(std::move(policy));
  }
};

TEST_P(PlannerTest, FindsWhatASearchWithoutSharedTokensFinds) {
  const Mind mind = PlannerTest::mind();
  const std::size_t context = mind.policy.architecture.context;
  Thinker thinker(mind);
  MatchSoFar so_far = begin_match(1.5);
  std::size_t widest = 0;
  for (std::size_t round = 0; round + 3 <= context; ++round) {
    for (const PlanSettings& settings : {PlanSettings{.depth = 3, .least_probability = 0},
                                         PlanSettings{.depth = 3, .least_probability = 0.35, .continuation = 0.9}}) {
      Planner planner(mind, settings);
      const Plan plan = planner.plan(thinker, so_far, dilemma, 3);
      const auto expected = searched(mind, so_far, settings, 3);
      EXPECT_NEAR(plan.values[0], expected[0], 1e-3) << "round " << round;
      EXPECT_NEAR(plan.values[1], expected[1], 1e-3) << "round " << round;
      EXPECT_NEAR(plan.belief, Thinker(mind).believe(so_far), 1e-4);
      widest = std::max(widest, plan.situations);
    }
    play_on(mind, so_far, all_outcomes[round % 4]);
  }
  EXPECT_EQ(widest, 21U);  // 1 + 4 + 16
}

TEST_P(PlannerTest, LooksNoFurtherThanTheEnd) {
  const Mind mind = PlannerTest::mind();
  Thinker thinker(mind);
  const MatchSoFar so_far = begin_match(1.5);
  Planner planner(mind, {.depth = 4});
  const Plan plan = planner.plan(thinker, so_far, dilemma, 1);
  EXPECT_EQ(plan.situations, 1U);
  EXPECT_NEAR(plan.values[0], 3 * plan.belief, 1e-9);
  EXPECT_NEAR(plan.values[1], 1 + 4 * plan.belief, 1e-9);
}

TEST_P(PlannerTest, AForcedBeliefIsOfThePresentRoundAlone) {
  const Mind mind = PlannerTest::mind();
  Thinker thinker(mind);
  MatchSoFar so_far = begin_match(1.5);
  Planner planner(mind, {.depth = 2, .least_probability = 0});
  const Plan forced = planner.plan(thinker, so_far, dilemma, 2, ForcedBelief{Move::D, false});
  for (const std::size_t own : {0U, 1U}) {
    const Outcome played = all_outcomes[2 * own + 1];
    MatchSoFar next = so_far;
    play_on(mind, next, played);
    const auto [c, d] = searched(mind, next, {.depth = 1}, 1);
    EXPECT_NEAR(forced.values[own], dilemma[played.index()] + std::max(c, d), 1e-3);
  }
}

TEST_P(PlannerTest, ABeliefForcedThroughoutIsAnOpponentWhoAlwaysPlaysThat) {
  const Mind mind = PlannerTest::mind();
  Thinker thinker(mind);
  const MatchSoFar so_far = begin_match(1.5);
  Planner planner(mind, {.depth = 3, .continuation = 0.5});
  const Plan c = planner.plan(thinker, so_far, dilemma, 3, ForcedBelief{Move::C});
  EXPECT_NEAR(c.values[0], 3 + 5 * 0.75, 1e-12);  // a D pays 5 in each round that follows
  EXPECT_NEAR(c.values[1], 5 + 5 * 0.75, 1e-12);
  const Plan d = planner.plan(thinker, so_far, dilemma, 3, ForcedBelief{Move::D});
  EXPECT_NEAR(d.values[0], 0.75, 1e-12);
  EXPECT_NEAR(d.values[1], 1.75, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(All, PlannerTest,
                         ::testing::Values(std::tuple{LossMode::teacher, Readout::token, std::size_t{1}},
                                           std::tuple{LossMode::teacher, Readout::token, std::size_t{3}},
                                           std::tuple{LossMode::teacher, Readout::token, std::size_t{7}},
                                           std::tuple{LossMode::selfconf, Readout::cat, std::size_t{2}}));

TEST(Planner, RefusesDepthsOutOfRange) {
  const Mind mind(test::playing_policy({}));
  test::expect_error<UsageError>([&] { Planner(mind, {.depth = 0}); }, "a plan of 0 rounds, expected 1 to 10");
  test::expect_error<UsageError>([&] { Planner(mind, {.depth = 11}); }, "a plan of 11 rounds");
}

}  // namespace
}  // namespace folk::sct
