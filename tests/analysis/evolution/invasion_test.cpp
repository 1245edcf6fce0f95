// Who invades whom: known facts, the definition spelt out, and figures that are not exact.

#include "games/ended_work.h"
#include "games/expect_error.h"

#include <folk/analysis/evolution/invasion.h>
#include <folk/analysis/pictures/invasion_drawing.h>
#include <folk/strategies/registry.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace folk {
namespace {

Tournament play(const std::string& roster, TournamentSettings settings = {}) {
  return play_tournament(Registry::standard().roster(roster, settings.payoffs), settings);
}

TournamentSettings under(const Criterion& criterion, double noise = 0) {
  TournamentSettings settings;
  settings.criterion = criterion;
  settings.noise = noise;
  return settings;
}

std::vector<std::string> names_of(const Tournament& tournament) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < tournament.size(); ++i) names.push_back(tournament.name(i));
  return names;
}

/// Maynard Smith & Price's condition in words.
Invasion by_definition(const Tournament& v, std::size_t j, std::size_t i) {
  if (v.score(j, i) > v.score(i, i)) return Invasion::strictly;
  if (v.score(j, i) < v.score(i, i)) return Invasion::resists;
  if (v.score(j, j) > v.score(i, j)) return Invasion::strictly;
  return v.score(j, j) < v.score(i, j) ? Invasion::resists : Invasion::weakly;
}

TEST(Invasions, AreTheDefinitionForExactScores) {
  const auto tournament = play("memory(1,1),gradual,soft_majo");
  const Invasions invasions(tournament);
  for (std::size_t i = 0; i < tournament.size(); ++i) {
    std::size_t strictly = 0;
    std::size_t weakly = 0;
    for (std::size_t j = 0; j < tournament.size(); ++j) {
      if (i == j) continue;
      const Invasion expected = by_definition(tournament, j, i);
      EXPECT_EQ(invasions.invasion(j, i), expected) << tournament.name(j) << " among " << tournament.name(i);
      strictly += expected == Invasion::strictly ? 1 : 0;
      weakly += expected == Invasion::weakly ? 1 : 0;
    }
    EXPECT_EQ(invasions.mutants(i, Invasion::strictly).size(), strictly);
    EXPECT_EQ(invasions.stability(i), strictly > 0 ? Stability::invaded
                                      : weakly > 0 ? Stability::neutrally_stable
                                                   : Stability::evolutionarily_stable);
  }
}

TEST(Invasions, KnownFacts) {
  // all_c, all_d, tit_for_tat over 100 rounds (Axelrod & Hamilton 1981).
  const Invasions three(play("all_c,all_d,tit_for_tat"));
  EXPECT_EQ(three.stability(1), Stability::evolutionarily_stable);
  EXPECT_EQ(three.stability(2), Stability::neutrally_stable);  // all_c drifts in
  EXPECT_EQ(three.invasion(0, 2), Invasion::weakly);
  EXPECT_EQ(three.invasion(1, 2), Invasion::resists);
  EXPECT_EQ(three.stability(0), Stability::invaded);
  EXPECT_EQ(three.mutants(0, Invasion::strictly), std::vector<std::size_t>{1});
  EXPECT_EQ(three.mutants(0, Invasion::weakly), std::vector<std::size_t>{2});
}

TEST(Invasions, OfAllDefectionUnderTheMeanDependOnTheSecondCondition) {
  // In the long run tit_for_tat earns as much among defectors as they do, and more among its own kind.
  const Invasions two(play("all_d,tit_for_tat", under(Criterion::mean())));
  EXPECT_EQ(two.invasion(1, 0), Invasion::strictly);
  EXPECT_EQ(two.invasion(0, 1), Invasion::resists);
}

TEST(Invasions, RoundingIsNoDifference) {
  // Two names for the same play: what is equal must stay equal where the scores are solved in doubles.
  const Invasions two(play("tit_for_tat,mem11_cCDCD,mem12_ccCDCDCDCD", under(Criterion::discounted(0.95), 0.03)));
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 2; ++j) EXPECT_EQ(two.invasion(j, i % 2), Invasion::weakly);
}

TEST(Invasions, WhatIsCutOffOrSampledMayBeUndecided) {
  const Invasions bounded(play("gradual,all_d", under(Criterion::mean())));
  EXPECT_EQ(bounded.invasion(1, 0), Invasion::undecided);
  EXPECT_EQ(bounded.stability(0), Stability::undecided);

  auto settings = under(Criterion::mean(), 0.05);
  settings.repetitions = 20;
  const Invasions sampled(play("all_c,gradual_soft,all_d", settings));
  EXPECT_EQ(sampled.invasion(2, 0), Invasion::strictly);  // 5 against 3: far beyond the errors
  settings.repetitions = 1;
  const Invasions once(play("all_c,gradual_soft,all_d", settings));
  EXPECT_EQ(once.invasion(1, 2), Invasion::undecided);
}

TEST(Invasions, NeedSelfPlay) {
  auto settings = under(Criterion::finite(10));
  settings.self_play = false;
  const auto tournament = play("all_c,all_d", settings);
  test::expect_error<UsageError>([&] { Invasions{tournament}; }, "self-play");
}

TEST(InvasionDrawing, HasAnArrowForEachInvasion) {
  const auto tournament = play("all_c,all_d,tit_for_tat");
  const std::string dot = to_dot(Invasions(tournament), names_of(tournament), "three \"old\" ones");
  EXPECT_NE(dot.find("b1 -> b0 [style=solid"), std::string::npos) << dot;
  EXPECT_NE(dot.find("b0 -> b2 [style=dashed"), std::string::npos) << dot;
  EXPECT_NE(dot.find("dir=both"), std::string::npos) << dot;
  EXPECT_NE(dot.find("three \\\"old\\\" ones"), std::string::npos) << dot;
  EXPECT_EQ(dot.find("b2 -> b1"), std::string::npos) << dot;
}

TEST(InvasionDrawing, PutsWhatIsAlikeIntoOneBoxAndDriftIntoAFrame) {
  const auto tournament = play("classics");
  const std::string dot = to_dot(Invasions(tournament), names_of(tournament), "classics");
  EXPECT_NE(dot.find("tit_for_tat\\nspiteful\\nhard_tft\\nmem2"), std::string::npos) << dot;
  EXPECT_NE(dot.find("cluster_neutral"), std::string::npos) << dot;
}

TEST(InvasionDrawing, RefusesTooMany) {
  const auto tournament = play("memory(1,1),classics");
  test::expect_error<UsageError>([&] { to_dot(Invasions(tournament), names_of(tournament), ""); }, "at most 40");
}

TEST(Invasions, EndAsTheirProgressWishes) {
  const auto tournament = play("all_c,all_d,tit_for_tat,pavlov");
  test::expect_ends([&](const Progress& progress) { EXPECT_EQ(Invasions(tournament, progress).size(), 4U); });
}

}  // namespace
}  // namespace folk
