#include <folk/games/error.h>
#include <folk/strategies/automaton.h>
#include <folk/strategies/registry.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace folk {
namespace {

std::string refusal(const std::string& spec) {
  try {
    Registry::standard().roster(spec);
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

std::vector<std::string> names(const std::string& spec) {
  std::vector<std::string> found;
  for (const auto& strategy : Registry::standard().roster(spec)) found.push_back(strategy.name);
  return found;
}

TEST(SplitList, KeepsBracketsAndQuotesWhole) {
  EXPECT_EQ(split_list("a, b(1,2) ,\"x,y\",exec:\"p (,\""),
            (std::vector<std::string>{"a", "b(1,2)", "\"x,y\"", "exec:\"p (,\""}));
  EXPECT_EQ(split_list(" , ,"), std::vector<std::string>{});
  EXPECT_THROW(split_list("a(1,2"), UsageError);
  EXPECT_THROW(split_list("exec:\"x"), UsageError);
}

TEST(NameKey, DropsCaseUnderscoresAndDashes) { EXPECT_EQ(name_key("Tit-For_Tat"), "titfortat"); }

TEST(Registry, HasTheRosters) {
  EXPECT_EQ(names("classics").size(), 17U);
  EXPECT_EQ(names("sct2025")[14], "gradual_sct");
  EXPECT_EQ(names("sct2025")[16], "mem2_sct");
  EXPECT_EQ(names("memory(1,1)").size(), 32U);
  EXPECT_EQ(names("memory(1,2)").size(), 1024U);
  EXPECT_EQ(names("memory(2,1)").size(), 1024U);
  EXPECT_EQ(names("memory(0,1)").size(), 8U);
  EXPECT_EQ(names("periodic(3)").size(), 14U);
  EXPECT_EQ(names("proba(2)").size(), 162U);
}

TEST(Registry, GivesCanonicalNames) {
  EXPECT_EQ(
      names("TFT,grim,wsls,MEM12_CCcdcddcdd,Per_CCD,random(0.30)"),
      (std::vector<std::string>{"tit_for_tat", "spiteful", "pavlov", "mem12_ccCDCDDCDD", "per_ccd", "random(0.3)"}));
  EXPECT_EQ(names("mem1(C; 0.9, .1,0.80,0)"), std::vector<std::string>{"mem1(c;0.9,0.1,0.8,0)"});
}

TEST(Registry, RefusesWithTheNearestNames) {
  EXPECT_NE(refusal("pavlow").find("pavlov"), std::string::npos) << refusal("pavlow");
  EXPECT_NE(refusal("titfortwotat").find("tf2t"), std::string::npos) << refusal("titfortwotat");
  EXPECT_NE(refusal("clasics").find("classics"), std::string::npos) << refusal("clasics");
}

TEST(Registry, RefusesWhatMakesNoStrategy) {
  for (const char* spec : {"",
                           ",",
                           "nobody",
                           "random",
                           "random()",
                           "random(2)",
                           "random(nan)",
                           "random(0.5",
                           "random(,0.5,)",
                           "pavlov(1)",
                           "mem12_cc",
                           "mem99_c",
                           "mem00_C",
                           "per_",
                           "per_xyz",
                           "memory",
                           "memory(1)",
                           "memory(0,0)",
                           "memory(2,2)",
                           "memory(9,9)",
                           "memory(1.5,1)",
                           "periodic(0)",
                           "periodic(99)",
                           "proba(0)",
                           "mem1(c;1,1,1)",
                           "mem1(x;1,1,1,1)",
                           "zd_extort(0.5)",
                           "zd_extort(3;9)",
                           "equalizer(4)",
                           "equalizer(2;0.9,0.9)",
                           "pavlov,wsls",
                           "classics,pavlov",
                           "@nowhere",
                           "exec:\"\"",
                           "pavlov)"})
    EXPECT_NE(refusal(spec), "accepted") << spec;
}

TEST(Registry, NamesTheStrategyGivenTwice) {
  EXPECT_NE(refusal("classics,tft").find("tit_for_tat"), std::string::npos);
}

TEST(Registry, UnquotesCommandsAndPaths) {
  EXPECT_EQ(names(R"(exec:"p \"a b\" \\ c")"), std::vector<std::string>{R"(exec:"p \"a b\" \\ c")"});
  EXPECT_EQ(names("exec:p"), std::vector<std::string>{R"(exec:"p")"});
  EXPECT_NE(refusal("@\"no,where.machines\"").find("no,where.machines: no such file"), std::string::npos);
  EXPECT_NE(refusal("@").find("needs the name of a file"), std::string::npos);
}

TEST(Registry, ComparesNamesAsItMatchesThem) {
  EXPECT_TRUE(same_name("Tit-For-Tat", "tit_for_tat"));
  EXPECT_FALSE(same_name("exec:\"a_b\"", "exec:\"ab\""));
}

TEST(Registry, RefusesToGiveANameTwice) {
  auto registry = Registry::standard();
  EXPECT_THROW(registry.add({"PAV-LOV", {}, "another", "nobody"}, nullptr), std::logic_error);
}

TEST(Registry, DescribesRostersAndFamilies) {
  const auto registry = Registry::standard();
  EXPECT_EQ(registry.describe("Classics").name, "classics");
  EXPECT_EQ(registry.describe("memory(1,2)").name, "memory(X,Y)");
  EXPECT_EQ(registry.describe("gtft(0.3)").name, "gtft(q)");
  EXPECT_THROW(registry.describe("nobody"), UsageError);
}

TEST(Registry, MakesOneStrategyOnly) {
  const auto registry = Registry::standard();
  EXPECT_EQ(registry.make("tft").name, "tit_for_tat");
  EXPECT_THROW(registry.make("classics"), UsageError);
  EXPECT_THROW(registry.make("pavlov,all_c"), UsageError);
  EXPECT_THROW(registry.make(""), UsageError);
}

TEST(MemoryFamilies, HaveTheKnownNumberOfBehaviours) {
  std::vector<Automaton> seen;
  for (const auto& strategy : Registry::standard().roster("memory(1,1)")) {
    const auto minimal = minimise(*tabulate(*strategy.machine, Sense::own_moves_its_own), Sense::own_moves_its_own);
    if (std::find(seen.begin(), seen.end(), minimal) == seen.end()) seen.push_back(minimal);
  }
  EXPECT_EQ(seen.size(), 26U);
}

TEST(ZeroDeterminant, UsesThePayoffsOfTheGame) {
  const auto registry = Registry::standard();
  const Payoffs other{4, 3, 1, 0};
  const auto a = registry.make("zd_extort(3)");
  const auto b = registry.make("zd_extort(3)", other);
  const State after_cc = a.machine->next(a.machine->start(), Move::C, Move::C);
  EXPECT_NE(a.machine->cooperation(after_cc), b.machine->cooperation(after_cc));
}

TEST(ZeroDeterminant, HasPressAndDysonsProbabilities) {
  // Press & Dyson 2012 at 5, 3, 1, 0 and chi = 3: phi at most 1/13, by default half of it: (11/13, 1/2, 7/26, 0).
  const auto extort = Registry::standard().make("zd_extort(3)");
  const auto& m = *extort.machine;
  const auto p = [&](Move own, Move theirs) { return m.cooperation(m.next(m.start(), own, theirs)); };
  EXPECT_NEAR(p(Move::C, Move::C), 11.0 / 13, 1e-15);
  EXPECT_NEAR(p(Move::C, Move::D), 0.5, 1e-15);
  EXPECT_NEAR(p(Move::D, Move::C), 7.0 / 26, 1e-15);
  EXPECT_EQ(p(Move::D, Move::D), 0);
}

// ZDGTFT-2 of Stewart & Plotkin 2013: what they call phi, 1/8, is phi / (R - S) here.
TEST(ZeroDeterminant, ThreeEighthsMakesZdgtft2) {
  const auto generous = Registry::standard().make("zd_generous(2;0.375)");
  const auto& m = *generous.machine;
  const auto p = [&](Move own, Move theirs) { return m.cooperation(m.next(m.start(), own, theirs)); };
  EXPECT_NEAR(p(Move::C, Move::C), 1, 1e-15);
  EXPECT_NEAR(p(Move::C, Move::D), 0.125, 1e-15);
  EXPECT_NEAR(p(Move::D, Move::C), 1, 1e-15);
  EXPECT_NEAR(p(Move::D, Move::D), 0.25, 1e-15);
}

}  // namespace
}  // namespace folk
