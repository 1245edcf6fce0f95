#include <folk/analysis/classes/behaviours.h>
#include <folk/analysis/classes/champion.h>
#include <folk/analysis/classes/class_tournament.h>
#include <folk/games/error.h>
#include <folk/strategies/automaton.h>
#include <folk/strategies/equivalence.h>

#include <gtest/gtest.h>

namespace folk {
namespace {

TEST(Behaviours, AreCountedAsMathieuAndDelahayeCountThem) {
  EXPECT_EQ(behaviours_of({1, 1}, 1).size(), 26U);
  EXPECT_EQ(behaviours_of({1, 2}, 2).size(), 820U);
}

TEST(Behaviours, AreWhatNoOpponentCanTellApart) {
  const MemoryClass members(1, 1);
  const Behaviours behaviours = behaviours_of(members, 1);
  for (std::uint32_t a = 0; a < 32; ++a)
    for (std::uint32_t b = 0; b < 32; ++b) {
      const auto one = members.member(a);
      const auto two = members.member(b);
      const bool alike = compare(one, two, Sense::own_moves_its_own, 1000).equivalence == Equivalence::equivalent;
      EXPECT_EQ(alike, behaviours.of_member[a] == behaviours.of_member[b]) << one.name() << " " << two.name();
    }
  std::size_t all = 0;
  for (std::size_t i = 0; i < behaviours.size(); ++i) {
    all += behaviours.members[i];
    EXPECT_EQ(behaviours.of_member[behaviours.first[i]], i);
  }
  EXPECT_EQ(all, 32U);
  EXPECT_THROW(behaviours_of({2, 3}, 1), UsageError);
}

TEST(Champion, OfASmallClassIsFirstInItsRanking) {
  ChampionSettings settings;
  settings.criterion = Criterion::finite(1000);
  const Champion champion = champion_of({1, 2}, settings);
  EXPECT_TRUE(champion.proved);
  EXPECT_EQ(champion.member, "mem12_ddCCDDDDDC");
  EXPECT_EQ(champion.equals, 4U);
  EXPECT_EQ(*champion.score.exact_mean, Rational(3'396'536) / Rational(1'024'000));
}

TEST(Champion, OfALargeClassIsALocalOptimumOnAnyNumberOfThreads) {
  const MemoryClass members(2, 3);
  ChampionSettings settings;
  settings.criterion = Criterion::finite(50);
  settings.evaluations = 1000;
  settings.most_leaves = 2'000;
  settings.seed = 3;
  const Champion champion = champion_of(members, settings);
  EXPECT_FALSE(champion.proved);
  EXPECT_EQ(champion.evaluations + champion.passed_over, 1000U);
  EXPECT_GT(champion.local_optima, 0U);
  EXPECT_GT(champion.score.mean, 3.0);  // permanent defection earns 3
  settings.threads = 3;
  EXPECT_EQ(champion_of(members, settings).member, champion.member);
}

}  // namespace
}  // namespace folk
