#include <folk/strategies/standard/selections.h>

#include <folk/games/error.h>
#include <folk/strategies/standard/memory_class.h>

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

namespace folk {
namespace {

std::vector<std::string> selected(const std::string& spec) {
  std::vector<std::string> names;
  for (const auto& strategy : Registry::standard().roster(spec)) names.push_back(strategy.name);
  return names;
}

// A seed means the same strategies for ever.
TEST(Sample, IsTheSameOnEveryMachine) {
  EXPECT_EQ(
      selected("sample(memory(2,2);5;seed=7)"),
      (std::vector<std::string>{"mem22_cdCCCCCDCCDDCDDCCD", "mem22_dcCDCCCDDCDCDDDDCD", "mem22_dcCDCCDCCCCDCCDDCC",
                                "mem22_ddCDCDCDCCCDCDDCCC", "mem22_ddCDDDDCDDCDDCDCCC"}));
  EXPECT_EQ(selected("sample(classics;3)"), (std::vector<std::string>{"all_d", "per_ccd", "mistrust"}));
  EXPECT_EQ(selected("sample(classics;3)"), selected("Sample( classics ; 3 ; SEED = 1 )"));
}

TEST(Sample, DrawsEveryGeneOfAClassTooLargeToList) {
  const MemoryClass members(4, 4);
  const auto names = selected("sample(memory(4,4);60)");
  EXPECT_EQ(std::set(names.begin(), names.end()).size(), 60U);
  for (std::size_t gene = 6; gene < 6 + members.genes(); ++gene) {
    std::set<char> values;
    for (const auto& name : names) values.insert(name[gene]);
    EXPECT_EQ(values.size(), 2U) << gene;
  }
}

TEST(Selections, StandInEachOtherAndInRosters) {
  EXPECT_EQ(selected("sample(sample(memory(1,2);50),memory(2,2);20;seed=2),all_c").size(), 21U);
  EXPECT_EQ(selected("half(memory(1,1);trained)").size() + selected("half(memory(1,1);held-out)").size(), 32U);
  EXPECT_EQ(selected("x=sample(classics;1)"), std::vector<std::string>{"x"});
  EXPECT_EQ(selected("sample(mem1(c;1,0,0,1),pavlov;2)").size(), 2U);
  // a strategy that overlaps enters once, as with other families
  EXPECT_EQ(selected("sample(classics;17),half(sct2025;trained),half(sct2025;held_out)").size(), 19U);
  for (const auto& strategy : Registry::standard().roster("sample(half(memory(3,3);held_out);5)"))
    EXPECT_EQ(half_of(*strategy.machine), Half::held_out);
}

TEST(Selections, RefuseInOneLine) {
  for (const char* wrong : {"sample",
                            "sample()",
                            "sample(classics)",
                            "sample(classics;)",
                            "sample(classics;0)",
                            "sample(classics;18)",
                            "sample(classics;3;seed=)",
                            "sample(classics;3;seed=-1)",
                            "sample(classics;3;seed=x)",
                            "sample(classics;seed=2;3)",
                            "sample(classics;3;3)",
                            "sample(classics;1.5)",
                            "sample(;1)",
                            "sample(classics,classics;3)",
                            "sample(memory(2,2);20001)",
                            "sample(memory(2,2),half(memory(2,2);trained);3)",
                            "half",
                            "half(classics)",
                            "half(classics;both)",
                            "half(memory(2,2);trained)",
                            "half(pavlov;trained),half(pavlov;held_out)",
                            "half(exec:cat;trained)",
                            "x=sample(classics;2)",
                            "memory(2,2),pavlov",
                            "sample(classics;2),sample(classics;2)"})
    EXPECT_THROW(selected(wrong), UsageError) << wrong;
}

}  // namespace
}  // namespace folk
