#include <folk/strategies/standard/filters.h>

#include "games/expect_error.h"

#include <folk/games/error.h>
#include <folk/strategies/facts.h>
#include <folk/strategies/registry.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace folk {
namespace {

std::vector<std::string> those(const std::string& conditions, const std::string& spec) {
  std::vector<std::string> names;
  for (const auto& strategy : Registry::standard().roster("where(" + spec + ";" + conditions + ")"))
    names.push_back(strategy.name);
  return names;
}

using Names = std::vector<std::string>;

TEST(Where, TakesThoseThatMeetAllConditions) {
  const std::string spec = "all_c,all_d,pavlov,prober,soft_majo,lunatic,tf2t";
  EXPECT_EQ(those("nice", spec), (Names{"all_c", "pavlov", "soft_majo", "tf2t"}));
  EXPECT_EQ(those("nice, memory<=1", spec), (Names{"all_c", "pavlov"}));
  EXPECT_EQ(those("not nice, deterministic", spec), (Names{"all_d", "prober"}));
  EXPECT_EQ(those("not finite", spec), (Names{"soft_majo"}));
  EXPECT_EQ(those("states = 2", spec), (Names{"pavlov"}));
  EXPECT_EQ(those("Memory > 2", spec), (Names{"prober", "soft_majo"}));
  EXPECT_EQ(those("states>=3,states<1000", spec), (Names{"prober", "tf2t"}));
}

TEST(Where, KnowsLittleOfPlayersWithoutAMachine) {
  const std::string spec = "first_by_shubik,first_by_downing,calculator,all_c";
  EXPECT_EQ(those("nice", spec), (Names{"first_by_shubik", "all_c"}));
  EXPECT_EQ(those("not machine", spec), (Names{"first_by_shubik", "first_by_downing", "calculator"}));
  EXPECT_EQ(those("finite", spec), (Names{"all_c"}));
  EXPECT_EQ(those("not machine, deterministic", spec), (Names{"first_by_shubik", "first_by_downing"}));
}

TEST(Where, StartsNoProgram) {
  const std::string spec = "exec(\"false\";deterministic),all_c";
  EXPECT_EQ(those("nice", spec), (Names{"all_c"}));
  EXPECT_EQ(those("deterministic", spec).size(), 2U);
}

TEST(Where, AgreesWithTheFacts) {
  for (const auto& strategy : Registry::standard().roster("where(axelrod_library; nice, memory<=2, finite)")) {
    const Facts facts = facts_of(*strategy.machine);
    EXPECT_TRUE(facts.finite && facts.niceness.nice) << strategy.name;
    EXPECT_EQ(facts.memory.kind, Memory::Kind::rounds) << strategy.name;
    EXPECT_LE(facts.memory.rounds, 2U) << strategy.name;
  }
}

TEST(Where, RefusesWhatIsNoCondition) {
  const auto refused = [](const std::string& item, const std::string& words) {
    test::expect_error<UsageError>([&] { Registry::standard().roster(item); }, words);
  };
  refused("where(classics)", "which?");
  refused("where(classics;kind)", "'kind' is no condition");
  refused("where(classics;)", "is no condition");
  refused("where(classics;memory<>2)", "is no condition");
  refused("where(classics;size<2)", "is no condition");
  refused("where(classics;memory<two)", "where memory");
  refused("where(all_d;nice)", "none is so");
}

}  // namespace
}  // namespace folk
