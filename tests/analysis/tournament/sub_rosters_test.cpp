// Ranks over sub-rosters against tournaments that are really played.

#include <folk/analysis/tournament/sub_rosters.h>
#include <folk/games/error.h>
#include <folk/strategies/registry.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace folk {
namespace {

Tournament tournament_of(const std::string& roster, const TournamentSettings& settings = {}) {
  return play_tournament(Registry::standard().roster(roster, settings.payoffs), settings);
}

std::map<std::string, SubRosterRanks> by_name(const Tournament& tournament, const SubRosters& found) {
  std::map<std::string, SubRosterRanks> ranks;
  for (std::size_t i = 0; i < tournament.size(); ++i) ranks[tournament.name(i)] = found.ranks[i];
  return ranks;
}

TEST(SubRosters, OfThreeByHand) {
  // all_d beats all_c by 60 to 30 and loses to tit_for_tat by 24 to 39, self-play included; the nice ones are level.
  TournamentSettings settings;
  settings.criterion = Criterion::finite(10);
  const Tournament tournament = tournament_of("all_c,all_d,tit_for_tat", settings);
  const SubRosters found = rank_sub_rosters(tournament, {.size = 2});
  EXPECT_EQ(found.possible, Integer(3));
  EXPECT_EQ(found.looked_at, 3U);
  EXPECT_TRUE(found.all);
  const auto ranks = by_name(tournament, found);
  EXPECT_EQ(ranks.at("tit_for_tat").mean, 1);
  EXPECT_EQ(ranks.at("tit_for_tat").won, 1);
  EXPECT_EQ(ranks.at("tit_for_tat").deviation, 0);
  for (const std::string name : {"all_c", "all_d"}) {
    const SubRosterRanks& entry = ranks.at(name);
    EXPECT_EQ(entry.sub_rosters, 2U);
    EXPECT_EQ(entry.mean, 1.5);
    EXPECT_EQ(entry.deviation, 0.5);
    EXPECT_EQ(entry.won, 0.5);
    EXPECT_EQ(std::vector({entry.best, entry.lower_quartile, entry.median, entry.upper_quartile, entry.worst}),
              (std::vector<std::size_t>{1, 1, 1, 2, 2}));
  }
  EXPECT_EQ(tournament.name(found.best_first[1]), "all_c") << "equal ones stand in roster order";
}

/// The ranks of each strategy when all sub-rosters are played, by the tournament itself.
std::map<std::string, std::vector<std::size_t>> played_ranks(const std::string& roster, std::size_t size,
                                                             const TournamentSettings& settings) {
  const auto all = Registry::standard().roster(roster, settings.payoffs);
  std::map<std::string, std::vector<std::size_t>> ranks;
  for (unsigned chosen = 0; chosen < 1U << all.size(); ++chosen) {
    std::vector<Strategy> members;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (((chosen >> i) & 1U) != 0) members.push_back(all[i]);
    if (members.size() != size) continue;
    const Tournament tournament = play_tournament(members, settings);
    for (const auto& entry : tournament.ranking()) ranks[tournament.name(entry.entrant)].push_back(entry.rank);
  }
  return ranks;
}

TEST(SubRosters, AreTheTournamentsOfTheirMembers) {
  // Equal totals in every setting: pavlov is mem11_cCDDC, and under mean the three that take turns differ by rounding.
  const std::string roster = "all_d,tit_for_tat,pavlov,mem11_cCDDC,per_ccd,per_cdc,per_dcc,random(0.5)";
  for (const double noise : {0.0, 0.01}) {
    for (const bool self_play : {true, false}) {
      TournamentSettings settings;
      settings.criterion = noise > 0 ? Criterion::mean() : Criterion::finite(20);
      settings.noise = noise;
      settings.self_play = self_play;
      const Tournament tournament = tournament_of(roster, settings);
      for (const std::size_t size : {3U, 5U}) {  // 5 of 8: what the others bring is taken away
        const auto expected = played_ranks(roster, size, settings);
        for (const auto& [name, entry] : by_name(tournament, rank_sub_rosters(tournament, {.size = size}))) {
          std::vector<std::size_t> ranks = expected.at(name);
          std::sort(ranks.begin(), ranks.end());
          double sum = 0;
          double won = 0;
          for (const std::size_t rank : ranks) {
            sum += static_cast<double>(rank);
            won += rank == 1 ? 1 : 0;
          }
          const auto all = static_cast<double>(ranks.size());
          EXPECT_EQ(entry.sub_rosters, ranks.size()) << name;
          EXPECT_NEAR(entry.mean, sum / all, 1e-12) << name;
          EXPECT_NEAR(entry.won, won / all, 1e-12) << name;
          EXPECT_EQ(std::vector({entry.best, entry.lower_quartile, entry.median, entry.upper_quartile, entry.worst}),
                    (std::vector{ranks.front(), ranks[(ranks.size() - 1) / 4], ranks[(ranks.size() - 1) / 2],
                                 ranks[(3 * ranks.size() - 1) / 4], ranks.back()}))
              << name;
        }
      }
    }
  }
}

TEST(SubRosters, ASampleIsFairAndTheSameForAnyThreads) {
  const Tournament tournament = tournament_of("classics");
  for (const std::size_t size : {5U, 12U}) {
    const auto all = by_name(tournament, rank_sub_rosters(tournament, {.size = size}));
    SubRosterSettings settings{.size = size, .samples = 2000, .seed = 7};
    const SubRosters drawn = rank_sub_rosters(tournament, settings);
    EXPECT_FALSE(drawn.all);
    EXPECT_EQ(drawn.possible, Integer(6188));
    for (const auto& [name, entry] : by_name(tournament, drawn)) {
      const auto counted = static_cast<double>(entry.sub_rosters);
      EXPECT_NEAR(counted, 2000.0 * static_cast<double>(size) / 17, 1) << name;
      const SubRosterRanks& exact = all.at(name);
      EXPECT_NEAR(entry.mean, exact.mean, 4 * exact.deviation / std::sqrt(counted)) << name;
      EXPECT_NEAR(entry.won, exact.won, 4 * std::sqrt(exact.won * (1 - exact.won) / counted)) << name;
    }
    settings.threads = 3;
    const SubRosters threaded = rank_sub_rosters(tournament, settings);
    settings.seed = 8;
    const SubRosters other = rank_sub_rosters(tournament, settings);
    bool differs = false;
    for (std::size_t i = 0; i < tournament.size(); ++i) {
      EXPECT_EQ(threaded.ranks[i].mean, drawn.ranks[i].mean);
      differs = differs || other.ranks[i].mean != drawn.ranks[i].mean;
    }
    EXPECT_TRUE(differs) << "another seed draws others";
  }
}

TEST(SubRosters, RefuseWhatThereIsNot) {
  const Tournament tournament = tournament_of("all_c,all_d,tit_for_tat");
  EXPECT_THROW(rank_sub_rosters(tournament, {.size = 1}), UsageError);
  EXPECT_THROW(rank_sub_rosters(tournament, {.size = 4}), UsageError);
  EXPECT_THROW(rank_sub_rosters(tournament, {.size = 2, .samples = 0}), UsageError);
  const SubRosters whole = rank_sub_rosters(tournament, {.size = 3});
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(whole.ranks[i].sub_rosters, 1U);
    EXPECT_EQ(whole.best_first[i], tournament.ranking()[i].entrant);
  }
  Progress progress;
  progress.cancel();
  EXPECT_THROW(rank_sub_rosters(tournament, {.size = 2}, progress), Cancelled);
}

}  // namespace
}  // namespace folk
