#include <folk/games/error.h>
#include <folk/strategies/standard/memory_class.h>

#include <gtest/gtest.h>

namespace folk {
namespace {

TEST(MemoryClass, CountsItsMembers) {
  EXPECT_EQ(MemoryClass(1, 2).size(), Integer(1024));
  EXPECT_EQ(MemoryClass(2, 2).size_text(), "262144");
  EXPECT_EQ(MemoryClass(3, 3).size_text(), "2^67");
  EXPECT_EQ(MemoryClass(3, 3).size().str(), "147573952589676412928");
  EXPECT_EQ(MemoryClass(4, 4).genes(), 260U);
}

TEST(MemoryClass, ListsThemInTheOrderOfTheirGenes) {
  const MemoryClass members(1, 2);
  EXPECT_EQ(members.member(0).name(), "mem12_ccCCCCCCCC");
  EXPECT_EQ(members.member(1).name(), "mem12_ccCCCCCCCD");
  EXPECT_EQ(members.member(1023).name(), "mem12_ddDDDDDDDD");
  EXPECT_EQ(members.member(std::vector<bool>{true, false, false, true, false, false, false, false, false, true}).name(),
            "mem12_dcCDCCCCCD");
}

TEST(MemoryClass, IsReadAsItIsNamed) {
  EXPECT_EQ(MemoryClass::parse("memory(2,2)"), MemoryClass(2, 2));
  EXPECT_EQ(MemoryClass::parse(" Memory( 0 , 3 )"), MemoryClass(0, 3));
  EXPECT_EQ(MemoryClass::parse(MemoryClass(4, 4).name()), MemoryClass(4, 4));
  for (const char* other : {"", "memory", "memory(1,2", "periodic(3)", "mem12_ccCDCDDCDD"})
    EXPECT_FALSE(MemoryClass::parse(other)) << other;
  for (const char* wrong : {"memory()", "memory(1)", "memory(1,2,3)", "memory(x,1)", "memory(0,0)", "memory(5,4)",
                            "memory(-1,2)", "memory(1,)", "memory(10,1)", "memory(1,1e9)"})
    EXPECT_THROW(MemoryClass::parse(wrong), UsageError) << wrong;
}

}  // namespace
}  // namespace folk
