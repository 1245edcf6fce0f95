// The tournament against the tables of other programs, and against itself.

#include "cases.h"
#include "csv.h"

#include <folk/analysis/play/sampled_play.h>
#include <folk/analysis/tournament/tournament.h>
#include <folk/games/error.h>
#include <folk/strategies/automaton.h>
#include <folk/strategies/registry.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "games/ended_work.h"

namespace folk {
namespace {

Tournament play(const std::string& roster, TournamentSettings settings = {}, const std::string& guests = {}) {
  const auto registry = Registry::standard();
  auto entrants = registry.roster(roster, settings.payoffs);
  const std::size_t core = entrants.size();
  if (!guests.empty())
    for (auto& guest : registry.roster(guests, settings.payoffs)) entrants.push_back(guest);
  return play_tournament(std::move(entrants), core, settings);
}

TournamentSettings over(std::uint64_t rounds) {
  TournamentSettings settings;
  settings.criterion = Criterion::finite(rounds);
  return settings;
}

void expect_matrix(const std::string& file, const Tournament& tournament, bool cooperations) {
  const auto rows = test::read_csv(file);
  ASSERT_EQ(rows.size(), tournament.size() + 1);
  for (std::size_t i = 0; i < tournament.size(); ++i)
    for (std::size_t j = 0; j < tournament.size(); ++j)
      EXPECT_EQ(cooperations ? tournament.cooperation(i, j) : tournament.score(i, j), std::stod(rows[i + 1][j + 1]))
          << file << ": " << tournament.name(i) << " v " << tournament.name(j);
}

TEST(Golden, TheClassicsOver100Rounds) {
  const auto tournament = play("classics", over(100));
  expect_matrix("classics17_100.csv", tournament, false);
  expect_matrix("classics17_100_coop.csv", tournament, true);
  EXPECT_EQ(tournament.name(tournament.ranking()[0].entrant), "gradual");
  EXPECT_EQ(tournament.ranking()[0].total, 4804);
}

TEST(Golden, TheSctPapersRosterAndItsNormalisedRewards) {
  const auto tournament = play("sct2025", over(100));
  expect_matrix("sct2025_100.csv", tournament, false);
  const auto rows = test::read_csv("sct_reconstructed_17.csv");
  for (std::size_t j = 0; j < 17; ++j) {
    double mean = 0;
    for (std::size_t i = 0; i < 17; ++i) mean += tournament.score(i, j) / 17;
    EXPECT_NEAR(mean, std::stod(rows[j + 1][2]), 5e-5) << rows[j + 1][0];
    // 100 x payoff / mean, for the payoffs that were recovered from the paper's table.
    EXPECT_NEAR(100 * std::stod(rows[j + 1][3]) / mean, std::stod(rows[j + 1][4]), 6e-4) << rows[j + 1][0];
    EXPECT_NEAR(*tournament.normalised(2, j), 100 * tournament.score(2, j) / mean, 1e-10);
  }
}

TEST(Golden, TheCompleteFamiliesOver1000Rounds) {
  for (const std::string family : {"1_1", "1_2"}) {
    const auto tournament = play("memory(" + family.substr(0, 1) + "," + family.substr(2) + ")", over(1000));
    std::map<std::string, std::pair<double, double>> expected;
    auto rows = test::read_csv("memory_" + family + "_1000.csv");
    for (std::size_t i = 1; i < rows.size(); ++i) expected[rows[i][1]] = {std::stod(rows[i][2]), std::stod(rows[i][3])};
    ASSERT_EQ(expected.size(), tournament.size());
    for (const auto& entry : tournament.ranking()) {
      const auto [total, cooperations] = expected.at(tournament.name(entry.entrant));
      EXPECT_EQ(entry.total, total);
      EXPECT_NEAR(entry.cooperation_rate * 1000 * static_cast<double>(tournament.size()), cooperations, 1e-6);
    }
  }
}

TEST(Tournament, EqualTotalsShareTheirRankInRosterOrder) {
  const auto tournament = play("tit_for_tat,all_c,mem01_cCD,all_d");
  const auto& ranking = tournament.ranking();
  for (std::size_t i = 1; i < ranking.size(); ++i) {
    if (ranking[i].total == ranking[i - 1].total) {
      EXPECT_EQ(ranking[i].rank, ranking[i - 1].rank);
      EXPECT_GT(ranking[i].entrant, ranking[i - 1].entrant);
    } else {
      EXPECT_EQ(ranking[i].rank, i + 1);
    }
  }
  EXPECT_LT(tournament.behaviours(), tournament.size());
}

TEST(Tournament, CountsWinsMediansAndMeans) {
  const auto tournament = play("all_c,all_d,tit_for_tat", over(10));
  const auto& best = tournament.ranking()[0];
  EXPECT_EQ(tournament.name(best.entrant), "all_d");
  EXPECT_EQ(best.total, 50 + 10 + 14);
  EXPECT_EQ(best.wins, 2U);
  EXPECT_DOUBLE_EQ(best.mean, 74.0 / 30);
  EXPECT_DOUBLE_EQ(best.median, 1.4);
  EXPECT_EQ(best.cooperation_rate, 0);
}

TEST(Tournament, LeavesTheDiagonalOut) {
  auto settings = over(10);
  settings.self_play = false;
  const auto tournament = play("all_c,all_d,mem01_cCC", settings);
  EXPECT_FALSE(tournament.played(1, 1));
  for (const auto& entry : tournament.ranking()) {
    // Two that always cooperate meet each other, not themselves.
    EXPECT_EQ(entry.total, tournament.name(entry.entrant) == "all_d" ? 100 : 30);
  }
}

TEST(Tournament, NormalisesByTheRosterAlone) {
  const auto with = play("classics", over(100), "grudger");
  const auto without = play("classics", over(100));
  EXPECT_EQ(with.core(), 17U);
  for (std::size_t i = 0; i < 17; ++i)
    for (std::size_t j = 0; j < 17; ++j) EXPECT_EQ(with.normalised(i, j), without.normalised(i, j));
  EXPECT_DOUBLE_EQ(*with.normalised(17, 0), 100 * 300 / 341.1764705882353);
}

TEST(Tournament, ScalesWithDecimalPayoffsExactly) {
  auto settings = over(10);
  settings.payoffs = parse_payoffs("T=0.5,R=0.3,P=0.1,S=0");
  const auto tournament = play("all_c,all_d", settings);
  EXPECT_EQ(tournament.score(0, 0), 3.0);
  EXPECT_EQ(tournament.score(1, 1), 1.0);
  EXPECT_EQ(tournament.score(1, 0), 5.0);
}

TEST(Tournament, CostsTheSameForATrillionRounds) {
  const auto tournament = play("classics,badbet", over(1'000'000'000));
  EXPECT_EQ(tournament.score(0, 0), 3e9);
  auto settings = over(1'000'000'000'000);
  const auto finite = play("all_c,all_d,spiteful,pavlov,soft_majo,hard_majo,prober,mem2", settings);
  EXPECT_EQ(finite.score(1, 0), 5e12);
}

TEST(Tournament, NamesThePairThatCannotBePlayed) {
  try {
    play("classics", over(1'000'000'000'000));
    FAIL();
  } catch (const UsageError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("gradual"), std::string::npos) << text;
  }
}

TEST(Tournament, RanksExactTotalsExactlyHoweverLarge) {
  const auto tournament = play("all_d,tit_for_tat,mistrust,spiteful", over(10'000'000'000'000));
  const auto& ranking = tournament.ranking();
  for (std::size_t i = 1; i < ranking.size(); ++i) {
    EXPECT_GE(ranking[i - 1].total, ranking[i].total);
    EXPECT_EQ(ranking[i - 1].total == ranking[i].total, ranking[i - 1].rank == ranking[i].rank);
  }
  // all_d scores 5 more than tit_for_tat and 5 more than spiteful in 10^13 rounds, as these cooperate once: two wins.
  // mistrust never does against it, and no other pair is unequal either.
  for (const auto& entry : ranking) EXPECT_EQ(entry.wins, entry.entrant == 0 ? 2U : 0U);
}

TEST(Tournament, TotalsThatCancelAreEqual) {
  auto settings = over(7);
  settings.payoffs = parse_payoffs("T=0.3,R=0.1,P=-0.1,S=-0.3");
  const auto tournament =
      play("random(0.5),mem1(0.5;0.3,0.7,0.7,0.3),mem1(0.5;0.4,0.6,0.6,0.4),mem1(0.5;0.3,0.7,0.3,0.7),all_c,all_d",
           settings);
  std::size_t ties = 0;
  for (std::size_t i = 1; i < tournament.size(); ++i)
    ties += tournament.ranking()[i].rank == tournament.ranking()[i - 1].rank ? 1 : 0;
  EXPECT_GE(ties, 1U);
}

TEST(Tournament, AddsTheErrorsOfOpponentsThatShareASample) {
  const auto machine = Registry::standard().make("random(0.5)").machine;
  const Strategy opaque{"opaque", nullptr, [machine] { return folk::play(machine); }};
  const auto error_against = [&](const std::string& opponents) {
    auto roster = Registry::standard().roster(opponents);
    roster.insert(roster.begin(), opaque);
    TournamentSettings settings;
    settings.self_play = false;
    const auto tournament = play_tournament(roster, settings);
    for (const auto& entry : tournament.ranking())
      if (entry.entrant == 0) return entry.error;
    return 0.0;
  };
  EXPECT_NEAR(error_against("random(0.5),mem1(0.5;0.5,0.5,0.5,0.5)"), 2 * error_against("random(0.5)"), 1e-9);
}

TEST(Tournament, TakesTheMeanErrorOfBothSeatsInSelfPlay) {
  const auto machine = Registry::standard().make("mem1(0.7;0.9,0.2,0.6,0.3)").machine;
  const Strategy opaque{"opaque", nullptr, [machine] { return folk::play(machine); }};
  auto settings = over(30);
  settings.repetitions = 10;
  const auto tournament = play_tournament({opaque}, settings);
  Sampling sampling;
  sampling.criterion = settings.criterion;
  sampling.repetitions = settings.repetitions;
  const auto seats = play_sampled({{&opaque, &opaque, 0}}, sampling).front();
  ASSERT_GT(std::abs(seats.first_error - seats.second_error), 0.1);
  const double mean = (seats.first_error + seats.second_error) / 2;
  EXPECT_DOUBLE_EQ(tournament.standard_error(0, 0), mean);
  EXPECT_DOUBLE_EQ(tournament.ranking()[0].error, mean);
}

TEST(Tournament, TakesNoNoticeOfAMixingStateOutOfReach) {
  const Automaton table({{1, {0, 1, 0, 1}}, {0, {0, 1, 0, 1}}, {0.5, {2, 2, 2, 2}}}, 0);
  std::vector<Strategy> roster{{"tft_and_more", std::make_shared<Automaton>(table), nullptr},
                               Registry::standard().make("soft_majo")};
  const auto tournament = play_tournament(roster, over(1'000'000'000'000));
  EXPECT_EQ(tournament.method(0, 1), Method::cycle);
  EXPECT_EQ(tournament.score(0, 1), 3e12);
}

TEST(Tournament, StaysExactNextToCertainty) {
  TournamentSettings settings;
  for (const double p : {1e-6, 1e-9, 1e-12, 1e-15}) {
    settings.criterion = Criterion::ending(p);
    EXPECT_NEAR(play("all_c", settings).ranking()[0].mean, 3, 1e-12) << p;
    EXPECT_NEAR(play("per_ccd", settings).ranking()[0].mean, 7.0 / 3, 1e-5) << p;
    EXPECT_NEAR(play("random(0.5)", settings).ranking()[0].mean, 2.25, 1e-12) << p;
  }
  settings.criterion = Criterion::mean();
  for (const double noise : {1e-3, 1e-9, 1e-14, 1e-17}) {
    settings.noise = noise;
    EXPECT_NEAR(play("tit_for_tat", settings).score(0, 0), 2.25, 1e-12) << noise;
  }
}

TEST(Tournament, CallsACutSumBounded) {
  TournamentSettings settings;
  settings.criterion = Criterion::discounted(0.9999999999);
  const auto tournament = play("gradual,all_d", settings);
  EXPECT_EQ(tournament.method(0, 1), Method::bounded);
  EXPECT_NEAR(tournament.score(1, 0), 1, 1e-4);  // all_d against gradual: D against D almost always
}

TEST(Tournament, RefusesMoreBehavioursThanFit) { EXPECT_THROW(play("proba(9)"), UsageError); }

TEST(Tournament, SaysHowEachFigureWasObtained) {
  TournamentSettings settings = over(50);
  settings.repetitions = 20;
  const auto tournament = play("all_d,pavlov,gradual,random(0.5)", settings);
  EXPECT_EQ(tournament.method(0, 1), Method::cycle);
  EXPECT_EQ(tournament.method(0, 2), Method::cycle);
  EXPECT_EQ(tournament.method(1, 3), Method::markov);
  // gradual is infinite, but not within 50 rounds.
  EXPECT_EQ(tournament.method(2, 3), Method::markov);
  // Nor within those that a discount factor of 0.9 leaves any weight, but then gradual has too many states.
  settings.criterion = Criterion::discounted(0.9);
  EXPECT_EQ(play("soft_majo,random(0.5)", settings).method(0, 1), Method::markov);
  EXPECT_EQ(play("gradual,random(0.5)", settings).method(0, 1), Method::sampled);
  settings.criterion = Criterion::mean();
  EXPECT_EQ(play("gradual,all_d", settings).method(0, 1), Method::bounded);
}

TEST(Tournament, UnrolledMachinesAgreeWithSampling) {
  TournamentSettings settings = over(30);
  settings.noise = 0.05;
  const auto exact = play("gradual,soft_majo,mem2,badbet", settings);
  const auto registry = Registry::standard();
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      if (i == 0 && j == 0) continue;  // two graduals have too many joint states even in 30 rounds
      EXPECT_EQ(exact.method(i, j), Method::markov) << exact.name(i) << " v " << exact.name(j);
      std::vector<Strategy> pair{registry.make(exact.name(i)), registry.make(exact.name(j))};
      // An opaque copy of the first can only be sampled.
      const auto machine = pair[0].machine;
      pair[0] = {"copy", nullptr, [machine] { return folk::play(machine); }};
      settings.repetitions = 3000;
      const auto sampled = play_tournament(pair, 2, settings);
      EXPECT_EQ(sampled.method(0, 1), Method::sampled);
      EXPECT_NEAR(sampled.score(0, 1), exact.score(i, j), 4 * sampled.standard_error(0, 1));
    }
}

TEST(Tournament, DiscountedMajoritiesAgreeWithTheirClosedForm) {
  // soft_majo and all_d without noise are a cycle; a trace of noise must change them by a trace.
  TournamentSettings settings;
  settings.criterion = Criterion::discounted(0.9);
  const auto pure = play("soft_majo,all_d,per_ccd", settings);
  settings.noise = 1e-9;
  const auto noisy = play("soft_majo,all_d,per_ccd", settings);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      if (i + j == 0) continue;  // two majorities have too many joint states
      EXPECT_EQ(noisy.method(i, j), Method::markov);
      EXPECT_NEAR(noisy.score(i, j), pure.score(i, j), 1e-6);
    }
}

TEST(Tournament, RefusesWhatMakesNoSense) {
  TournamentSettings settings;
  EXPECT_THROW(play_tournament({}, 0, settings), UsageError);
  EXPECT_THROW(settings.noise = 1.5, UsageError);
  EXPECT_THROW(settings.noise = std::nan(""), UsageError);
  EXPECT_THROW(settings.repetitions = 0, UsageError);
  settings.repetitions = 1;
  settings.self_play = false;
  EXPECT_THROW(play("all_c", settings), UsageError);
}

TEST(TournamentThreads, GiveTheSameResultsForAnyNumber) {
  auto settings = over(test::cases<std::uint64_t>(60));
  settings.noise = 0.01;
  settings.repetitions = 5;
  const std::string roster = "classics,random(0.3),gtft(0.2)";
  settings.threads = 1;
  const auto one = play(roster, settings);
  settings.threads = 4;
  std::size_t reports = 0;
  const auto four = play_tournament(Registry::standard().roster(roster), settings, [&](double) { ++reports; });
  EXPECT_EQ(one.signature(), four.signature());
  EXPECT_GT(reports, 0U);
  for (std::size_t i = 0; i < one.size(); ++i)
    for (std::size_t j = 0; j < one.size(); ++j) EXPECT_EQ(one.score(i, j), four.score(i, j));
  settings.seed = 2;
  settings.criterion = Criterion::discounted(0.9);
  const auto seed_two = play(roster, settings);
  settings.seed = 3;
  EXPECT_NE(seed_two.signature(), play(roster, settings).signature());
}

TEST(TournamentThreads, EndAsTheirProgressWishes) {
  auto settings = over(20);
  settings.repetitions = 2;
  auto roster = Registry::standard().roster("classics,random(0.3)");
  for (const bool thinks_together : {false, true}) {
    if (thinks_together) {
      const auto machine = Registry::standard().make("tit_for_tat").machine;
      Strategy thinker{"thinker", nullptr, [machine] { return folk::play(machine); }};
      thinker.thinks_together = true;
      roster.push_back(thinker);
    }
    settings.threads = 1;
    const auto signature = play_tournament(roster, settings).signature();
    for (const unsigned threads : {1U, 4U}) {
      settings.threads = threads;
      test::expect_ends([&](const Progress& progress) {
        EXPECT_EQ(play_tournament(roster, settings, progress).signature(), signature);
      });
    }
  }
}

}  // namespace
}  // namespace folk
