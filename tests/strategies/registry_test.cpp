#include <folk/games/error.h>
#include <folk/games/outcome.h>
#include <folk/strategies/automaton.h>
#include <folk/strategies/registry.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
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
  const auto deep = [](std::size_t n) { return std::string(n, '(') + std::string(n, ')'); };
  EXPECT_EQ(split_list(deep(deepest_brackets)).size(), 1U);
  EXPECT_THROW(split_list(deep(deepest_brackets + 1)), UsageError);
}

TEST(NameKey, DropsCaseBlanksUnderscoresAndDashes) {
  EXPECT_EQ(name_key("Tit-For_Tat"), "titfortat");
  EXPECT_EQ(name_key(" Win-Stay\tLose-Shift "), "winstayloseshift");
}

TEST(SplitLastArgument, TakesWhatStandsBehindTheLastSemicolon) {
  EXPECT_EQ(split_last_argument("mem1(c;1,0,0,1) ; 4 ").last, "4");
  EXPECT_EQ(split_last_argument("a;b;c").spec, "a;b");
  EXPECT_FALSE(split_last_argument("classics").last);
  EXPECT_EQ(value_of_option("Seed = 7", "seed"), "7");
  EXPECT_FALSE(value_of_option("depth=7", "seed"));
  EXPECT_FALSE(value_of_option("seed", "seed"));
}

TEST(SplitLabel, TakesWhatStandsBeforeTheSign) {
  EXPECT_EQ(split_label("hard = random(0.2)").label, "hard");
  EXPECT_EQ(split_label("hard = random(0.2)").spec, "random(0.2)");
  for (const char* whole : {"pavlov", "bayes(pavlov;depth=3)", "exec:p --x=1", "@a=b", "\"a=b\"", "sct:a=b.bin", ""}) {
    EXPECT_FALSE(split_label(whole).label) << whole;
    EXPECT_EQ(split_label(whole).spec, whole);
  }
  EXPECT_EQ(split_label("mine=exec:\"p --x=1\"").spec, "exec:\"p --x=1\"");
  for (const char* wrong : {"=pavlov", "-x=pavlov", "a b=pavlov", "a!=pavlov", "a/b=pavlov", "a="})
    EXPECT_THROW(split_label(wrong), UsageError) << wrong;
  EXPECT_THROW(split_label(std::string(101, 'a') + "=pavlov"), UsageError);
}

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

TEST(Registry, ReadsNamesAsPeopleWriteThem) {
  EXPECT_EQ(names("Tit For Tat,Win-Stay Lose-Shift,Go By Majority,Slow Tit For Two Tats 2,per ccd,gtft (0.3)"),
            (std::vector<std::string>{"tit_for_tat", "pavlov", "soft_majo", "slow_tft", "per_ccd", "gtft(0.3)"}));
  EXPECT_EQ(Registry::standard().describe("Tit For Tat").name, "tit_for_tat");
}

TEST(Registry, KeepsFractionsExactly) {
  EXPECT_EQ(names("gtft(1/3),random(1/2),joss(9/10),zd_extort(4;1/17),zd_generous(7/3),equalizer(7/3;5/6),"
                  "mem1(1/7;1,1/3,1,1/3),mem1(0/1;1,1e-7,1,.25)"),
            (std::vector<std::string>{"gtft(1/3)", "random(0.5)", "joss(0.9)", "zd_extort(4;1/17)", "zd_generous(7/3)",
                                      "equalizer(7/3;5/6)", "mem1(1/7;1,1/3,1,1/3)", "mem1(d;1,1e-07,1,0.25)"}));
  EXPECT_NE(refusal("gtft(1/3),gtft(2/6)").find("'gtft(1/3)' is given twice"), std::string::npos);
  const auto third = Registry::standard().make("gtft(1/3)");
  const auto& machine = *third.machine;
  EXPECT_EQ(machine.cooperation(machine.next(machine.start(), Move::C, Move::D)), 1.0 / 3);
  for (const char* wrong : {"gtft(4/3)", "gtft(1/0)", "random(-1/2)", "zd_extort(1/2)", "zd_extort(4;1/16)",
                            "memory(1/2,1)", "mem1(c;1,1/3,1,1/)", "gtft(1e999999999)"})
    EXPECT_NE(refusal(wrong), "accepted") << wrong;
  EXPECT_EQ(names("periodic(1e0)").size(), 2U);
}

TEST(Registry, MergesRostersAndFamiliesThatOverlap) {
  EXPECT_EQ(names("all,periodic(3)").size(), names("all").size() + 14 - 3);
  EXPECT_EQ(names("periodic(3),periodic(2)"), names("periodic(3)"));
  EXPECT_EQ(names("classics,sct2025").size(), 19U);
  EXPECT_EQ(names("proba(1),proba(2)").size(), 162U);
  EXPECT_EQ(names("proba(3),proba(6)").size(), names("proba(6)").size());
  for (const char* twice : {"classics,classics", "periodic(3),Periodic( 3 )", "per_cd,periodic(3)",
                            "periodic(3),per_cd", "all,pavlov", "pavlov,pavlov", "periodic(2),x=per_cd,per_cd"})
    EXPECT_NE(refusal(twice).find("given twice"), std::string::npos) << twice;
  EXPECT_NE(refusal("proba(3),mem1(c;1,1/3,1,1/3)").find("given twice"), std::string::npos);
}

TEST(Registry, HasTheFieldsOfTheLiterature) {
  EXPECT_EQ(names("axelrod1980").size(), 15U);
  EXPECT_EQ(names("stewart_plotkin2012").size(), 19U);
  EXPECT_EQ(names("axelrod_library").size(), 187U);
}

TEST(Registry, LabelsASingleEntrant) {
  EXPECT_EQ(names("hard=random(0.2),soft=random(0.8),pavlov,Mine=tft"),
            (std::vector<std::string>{"hard", "soft", "pavlov", "Mine"}));
  EXPECT_EQ(Registry::standard().make("a=tft").name, "a");
  EXPECT_EQ(Registry::standard().describe("a=tft").name, "tit_for_tat");
  EXPECT_EQ(names("a=exec:\"p --x=1\""), std::vector<std::string>{"a"});
  for (const char* twice : {"a=tft,A=pavlov", "a=tft,_a_=pavlov", "pavlov=tft,pavlov", "pavlov=tft,classics"})
    EXPECT_NE(refusal(twice), "accepted") << twice;
  for (const char* several : {"a=classics", "a=periodic(2)", "a=memory(1,1)"})
    EXPECT_NE(refusal(several).find("a label names one strategy"), std::string::npos) << several;
  for (const char* wrong : {"a=", "=tft", "a=b=tft", "a=nobody", "a==tft"})
    EXPECT_NE(refusal(wrong), "accepted") << wrong;
}

TEST(Registry, ReadsFilesByTheReaderThatItIsGiven) {
  const auto registry = Registry::standard([](const std::string& path) {
    return path == "two" ? "machine a; c C c c\nmachine b; d D d d\n" : "machine a; d D d d\n";
  });
  const auto roster = registry.roster("x=@two#a,y=@two#b,z=@one,@-");
  ASSERT_EQ(roster.size(), 4U);
  EXPECT_EQ(roster[2].name, "z");
  EXPECT_EQ(roster[3].name, "a");
  EXPECT_THROW(registry.roster("@two,@one"), UsageError);  // two machines a, and neither has a label
  EXPECT_THROW(registry.roster("x=@two"), UsageError);
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

TEST(Registry, TellsAStrategyWithParametersFromOneWithoutOfTheSameName) {
  auto registry = Registry::standard();
  const auto maker = [](double cooperation) {
    return [=](const std::string& name, std::string_view arguments, const Payoffs&) {
      Strategy strategy = Registry::standard().make(cooperation > 0 ? "all_c" : "all_d");
      strategy.name = name + "/" + std::string(arguments);
      return strategy;
    };
  };
  registry.add({"plan(FILE)", {}, "with one", "nobody"}, maker(0));
  registry.add({"plan", {}, "without", "nobody"}, maker(1));
  EXPECT_THROW(registry.add({"plan(N)", {}, "another", "nobody"}, maker(0)), std::logic_error);
  EXPECT_EQ(registry.make("plan").name, "plan/");
  EXPECT_EQ(registry.make("plan(x)").name, "plan(FILE)/x");
  EXPECT_EQ(registry.describe("plan").behaviour, "without");
  EXPECT_EQ(registry.describe("Plan(y)").behaviour, "with one");
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

// They are computed exactly and rounded once: no 1.39e-17 where the formula says 0.
TEST(ZeroDeterminant, IsExact) {
  const auto after = [](const std::string& name, const Payoffs& payoffs = {}) {
    const auto strategy = Registry::standard().make(name, payoffs);
    std::array<double, 4> p{};
    for (const Outcome o : all_outcomes)
      p[o.index()] = strategy.machine->cooperation(strategy.machine->next(strategy.machine->start(), o.own, o.theirs));
    return p;
  };
  using Four = std::array<double, 4>;
  EXPECT_EQ(after("zd_extort(4;1/17)"), (Four{11.0 / 17, 0, 8.0 / 17, 0}));
  EXPECT_EQ(after("zd_extort(3)"), (Four{11.0 / 13, 0.5, 7.0 / 26, 0}));
  EXPECT_EQ(after("zd_extort(17/5)"), after("zd_extort(3.4)"));
  EXPECT_EQ(after("zd_extort(3)", {Rational(1, 3), Rational(1, 5), Rational(1, 7), 0})[3], 0);
  EXPECT_EQ(after("zd_generous(2)")[0], 1);
  for (int chi = 2; chi < 100; ++chi) EXPECT_EQ(after("zd_extort(" + std::to_string(chi) + ")")[3], 0) << chi;
  EXPECT_EQ(after("equalizer(7/3;5/6)"), (Four{5.0 / 6, 1.0 / 3, 7.0 / 12, 1.0 / 3}));
  EXPECT_EQ(after("equalizer(7/3;5/6,0.333333333333)"), after("equalizer(7/3;5/6)"));  // a person's third
}

}  // namespace
}  // namespace folk
