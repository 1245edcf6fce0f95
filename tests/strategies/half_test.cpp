#include <folk/strategies/half.h>

#include <folk/strategies/automaton.h>

#include <gtest/gtest.h>

#include <map>
#include <vector>

#include "named.h"

namespace folk {
using test::named;
using test::roster;

namespace {

std::uint64_t key_of(const std::string& name) { return behaviour_key(*named(name).machine); }

TEST(BehaviourKey, TellsBehavioursApartAndNothingElse) {
  std::map<std::uint64_t, Automaton> behaviours;
  for (const auto& strategy : roster("memory(1,1),memory(0,2),periodic(3),classics")) {
    if (!strategy.machine->finite()) continue;
    const auto minimal = minimise(*tabulate(*strategy.machine, Sense::own_moves_its_own), Sense::own_moves_its_own);
    const auto [known, is_new] = behaviours.try_emplace(behaviour_key(*strategy.machine), minimal);
    EXPECT_EQ(known->second, minimal) << strategy.name;
  }
  std::vector<Automaton> different;
  for (const auto& [key, automaton] : behaviours) {
    EXPECT_EQ(std::count(different.begin(), different.end(), automaton), 0);
    different.push_back(automaton);
  }
  EXPECT_GT(different.size(), 40U);
}

TEST(BehaviourKey, KnowsAStrategyUnderEveryName) {
  EXPECT_EQ(key_of("spiteful"), key_of("mem11_cCDDD"));  // they differ only once an own move slips
  EXPECT_EQ(key_of("random(0)"), key_of("all_d"));
  EXPECT_EQ(key_of("mem1(c;1,0.3,1,0.3)"), key_of("gtft(0.3)"));
  EXPECT_NE(key_of("gtft(0.4)"), key_of("gtft(0.3)"));
  EXPECT_NE(key_of("soft_majo"), key_of("hard_majo"));
}

TEST(BehaviourKey, LooksAtThirtyTwoRounds) {
  EXPECT_NE(key_of("per_" + std::string(31, 'c') + "d"), key_of("all_c"));
  EXPECT_EQ(key_of("per_" + std::string(32, 'c') + "d"), key_of("all_c"));
}

// Others would make what was trained on unknown: these are recorded, not derived.
TEST(Half, IsAFixedRule) {
  EXPECT_EQ(key_of("tit_for_tat"), 10225861773041047172U);
  EXPECT_EQ(key_of("gtft(0.3)"), 3971153307417370242U);
  EXPECT_EQ(half_of(*named("all_c").machine), Half::held_out);
  EXPECT_EQ(half_of(*named("tit_for_tat").machine), Half::trained);
}

TEST(Half, IsOneOfTwoThatAreAboutAsLarge) {
  std::size_t trained = 0;
  const auto all = roster("memory(1,2)");
  for (const auto& strategy : all) trained += half_of(*strategy.machine) == Half::trained ? 1U : 0U;
  EXPECT_NEAR(static_cast<double>(trained), 512, 100);
}

}  // namespace
}  // namespace folk
