// The way told by few against the way of all members.

#include <folk/analysis/evolution/leading_behaviours.h>

#include <gtest/gtest.h>

#include <memory>
#include <numeric>

namespace folk {
namespace {

TEST(LeadingBehaviours, AreSummedOverTheirMembersInEveryGeneration) {
  const MemoryClass members(1, 2);
  const Population start(1024, 100);
  const auto selection = std::make_shared<ClassSelection>(members, Payoffs{}, Criterion::finite(1000), start, 2);
  Evolution evolution(selection, start);
  evolution.run(30);
  const Behaviours& behaviours = selection->behaviours();
  const LeadingBehaviours found = leading_behaviours(selection, start, evolution.state(), 5);
  ASSERT_EQ(found.members.size(), 5U);
  EXPECT_EQ(found.others, 815U);
  ASSERT_EQ(found.rows.size(), 31U);
  for (const auto& [generation, population] : evolution.state().history.rows()) {
    const auto& row = found.rows[generation];
    EXPECT_EQ(row.generation, generation);
    ASSERT_EQ(row.population.size(), 6U);
    for (std::size_t i = 0; i < 5; ++i) {
      double expected = 0;
      for (std::size_t member = 0; member < population.size(); ++member)
        if (behaviours.of_member[member] == behaviours.of_member[found.members[i]]) expected += population[member];
      EXPECT_EQ(row.population[i], expected) << generation;
      if (generation == 30 && i > 0) {
        EXPECT_GE(row.population[i - 1], expected);
      }
    }
    EXPECT_EQ(std::accumulate(row.population.begin(), row.population.end(), 0.0),
              std::accumulate(population.begin(), population.end(), 0.0));
  }
  // Nobody dead leads, and no leader is forgotten.
  const LeadingBehaviours all = leading_behaviours(selection, start, evolution.state(), 1000);
  EXPECT_LT(all.members.size(), 820U);
  EXPECT_EQ(all.rows.back().population.back(), 0);
  EXPECT_GT(all.rows.back().population[all.members.size() - 1], 0);
}

}  // namespace
}  // namespace folk
