#include <folk/strategies/registry.h>
#include <folk/strategies/same_strategies.h>

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace folk {
namespace {

using Names = std::vector<std::string>;

std::vector<Names> named(const std::vector<Strategy>& strategies, const std::vector<std::vector<std::size_t>>& groups) {
  std::vector<Names> names;
  for (const auto& group : groups) {
    names.emplace_back();
    for (const std::size_t i : group) names.back().push_back(strategies[i].name);
  }
  return names;
}

TEST(SameStrategies, AreThoseThatNoPlaySeparates) {
  const auto roster = Registry::standard().roster(
      "mem01_cCD,spiteful,tit_for_tat,mem11_cCDDD,mem11_cCDCD,all_d,mem11_dDDDD,random(0.5)");
  const auto its_own = same_strategies(roster, Sense::own_moves_its_own);
  EXPECT_EQ(named(roster, its_own.groups),
            (std::vector<Names>{
                {"mem01_cCD", "tit_for_tat", "mem11_cCDCD"}, {"spiteful", "mem11_cCDDD"}, {"all_d", "mem11_dDDDD"}}));
  EXPECT_TRUE(its_own.undecided.empty());
  // A spiteful whose own D slips is not forgotten; that of the last round is.
  const auto any_own = same_strategies(roster, Sense::any_own_moves);
  EXPECT_EQ(named(roster, any_own.groups),
            (std::vector<Names>{{"mem01_cCD", "tit_for_tat", "mem11_cCDCD"}, {"all_d", "mem11_dDDDD"}}));
}

TEST(SameStrategies, LongRunsTellLongMemoriesApart) {
  // Breadth first comes to some dozen rounds; windows of 20 and 40 moves differ from the 32nd on.
  const auto roster = Registry::standard().roster("go_by_majority_20,go_by_majority_40,soft_majo");
  const auto found = same_strategies(roster, Sense::own_moves_its_own, 1000);
  EXPECT_TRUE(found.groups.empty());
  EXPECT_TRUE(found.undecided.empty());
}

TEST(SameStrategies, SaysWhereNothingIsProved) {
  auto roster = Registry::standard().roster("soft_majo,tit_for_tat");
  Strategy twin = roster.front();
  twin.name = "twin";
  roster.push_back(twin);
  roster.push_back({"player", nullptr, [] { return std::unique_ptr<Player>(); }});
  const auto found = same_strategies(roster, Sense::own_moves_its_own, 1000);
  EXPECT_TRUE(found.groups.empty());
  EXPECT_EQ(found.undecided, (std::vector<std::pair<std::size_t, std::size_t>>{{0, 2}}));
  EXPECT_EQ(found.opaque, std::vector<std::size_t>{3});
}

}  // namespace
}  // namespace folk
