#include <folk/sct/data/recorded_play.h>
#include <folk/sct/policy/belief_effect.h>
#include <folk/sct/policy/sct_player.h>
#include <folk/sct/training/aggregation.h>
#include <folk/strategies/registry.h>
#include <sct/policy/playing_policy.h>

#include <gtest/gtest.h>

namespace folk::sct {
namespace {

const std::vector<Strategy>& roster() {
  static const auto strategies = Registry::standard().roster("all_c,all_d,tit_for_tat,per_cd");
  return strategies;
}

/// The same count by players whose belief is forced throughout: each is told the match as it was and asked anew.
std::uint64_t changed(const std::shared_ptr<const Mind>& mind, Move forced) {
  const auto matches =
      play_and_record(transformer("policy", mind), roster(), mind->policy.training.payoffs, 14, 0, 1, 1);
  PlayOptions options;
  options.forced_belief = forced;
  const auto strategy = transformer("forced", mind, options);
  std::uint64_t count = 0;
  for (const auto& match : matches) {
    const auto player = strategy.new_player();
    player->start({mind->policy.training.payoffs, Criterion::finite(14), {}});
    for (std::size_t t = 0; t < match.rounds(); ++t) {
      count += player->move() != match.own[t] ? 1U : 0U;
      player->observe(match.own[t], match.theirs[t]);
    }
  }
  return count;
}

TEST(BeliefEffect, CountsTheMovesThatAForcedBeliefChanges) {
  std::uint64_t all = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const auto mind = test::playing_mind(test::trainings[0], seed);
    const auto effect = belief_effect(mind, roster(), 2);
    EXPECT_EQ(effect.rounds, 4U * 14U);
    EXPECT_EQ(effect.changed_by_c, changed(mind, Move::C));
    EXPECT_EQ(effect.changed_by_d, changed(mind, Move::D));
    EXPECT_EQ(effect.present_by_c, effect.changed_by_c);
    EXPECT_EQ(effect.present_by_d, effect.changed_by_d);
    all += effect.changed_by_c + effect.changed_by_d;
  }
  EXPECT_GT(all, 0U) << "none of these policies heeds its belief: a poor test";
}

TEST(BeliefEffect, OfAPlannerIsThatOnItsPlans) {
  std::uint64_t all = 0, present = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    Policy policy = test::playing_policy(test::trainings[0], seed);
    policy.training.plan_depth = 2;
    policy.training.payoffs = {5, 3, 0, 1};  // chicken, where the better move is another against D
    const auto mind = std::make_shared<const Mind>(policy);
    const auto effect = belief_effect(mind, roster(), 2);
    EXPECT_EQ(effect.changed_by_c, changed(mind, Move::C));
    EXPECT_EQ(effect.changed_by_d, changed(mind, Move::D));
    // Who always plays C is answered by D, who always plays D by C: each move is changed by one of the two.
    EXPECT_EQ(effect.changed_by_c + effect.changed_by_d, effect.rounds);
    present += effect.present_by_c + effect.present_by_d;
    all += effect.rounds;
  }
  EXPECT_GT(present, 0U);
  EXPECT_NE(present, all) << "the present round alone is forced as if it were all";
}

TEST(BeliefEffect, OfEachOpponentIsItsEffectAlone) {
  const auto mind = test::playing_mind(test::trainings[0], 3);
  const auto effects = belief_effects(mind, roster(), 2);
  ASSERT_EQ(effects.size(), roster().size());
  BeliefEffect sum;
  for (std::size_t i = 0; i < effects.size(); ++i) {
    EXPECT_EQ(effects[i], belief_effect(mind, {roster()[i]})) << roster()[i].name;
    sum += effects[i];
  }
  EXPECT_EQ(sum, belief_effect(mind, roster()));
}

TEST(BeliefEffect, ThereIsNoneWhereTheActionDoesNotReadTheBelief) {
  for (const auto& training : test::trainings) {
    if (training.readout != Readout::own) continue;
    const auto effect = belief_effect(test::playing_mind(training), roster());
    EXPECT_EQ(effect.rounds, 4U * 14U);
    EXPECT_EQ(effect.changed_by_c + effect.changed_by_d, 0U) << training.name;
  }
}

}  // namespace
}  // namespace folk::sct
