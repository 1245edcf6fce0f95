// What is kept of contests that are played.

#include <analysis/play/mirror.h>
#include <folk/analysis/play/pair_player.h>
#include <folk/analysis/play/sampled_play.h>
#include <folk/analysis/tournament/tournament.h>
#include <folk/games/error.h>
#include <folk/strategies/registry.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

namespace folk {
namespace {

using test::Diary;
using test::mirror;
using test::opaque;
using test::with_classics;

TEST(SampledPlay, RefusesWhatTakesTooLong) {
  const Strategy toy = mirror(std::make_shared<Diary>(), true, true);
  Sampling sampling;
  sampling.criterion = Criterion::finite(1'000'000'000);
  EXPECT_THROW(play_sampled({{&toy, &toy, 0, true}}, sampling), UsageError);
  sampling.criterion = Criterion::finite(10'000'000);
  EXPECT_THROW(play_sampled({{&toy, &toy, 0}}, sampling), UsageError);
  TournamentSettings settings;
  settings.criterion = Criterion::finite(1'000'000'000);
  try {
    const auto tournament = play_tournament({toy}, settings);
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("mirror against mirror"), std::string::npos) << error.what();
  }
}

TEST(SampledPlay, OneMatchOfDeterministicPlayersIsAllThereIs) {
  const auto registry = Registry::standard();
  Strategy copy = opaque("gradual");
  copy.deterministic = true;
  for (const auto& criterion : {Criterion::finite(100), Criterion::discounted(0.95), Criterion::ending(0.02),
                                Criterion::discounted(1e-9), Criterion::ending(1)}) {
    for (const bool together : {false, true}) {
      copy.thinks_together = together;
      for (const auto& other : registry.roster("pavlov,per_ccd,all_d,gradual")) {
        Sampling sampling;
        sampling.criterion = criterion;
        const auto played = play_pair(copy, other, sampling);
        const auto exact = play_pair(registry.make("gradual"), other, sampling);
        EXPECT_EQ(played.method, Method::played);
        for (std::size_t o = 0; o < 4; ++o)
          EXPECT_NEAR(played.weights[o], exact.weights[o], criterion.is_finite() ? 0 : 1e-11 * criterion.total_weight())
              << criterion.to_string() << " " << other.name;
      }
    }
  }
  Sampling sampling;
  sampling.criterion = Criterion::mean();
  EXPECT_EQ(play_pair(copy, registry.make("pavlov"), sampling).method, Method::bounded);
  sampling.criterion = Criterion::finite(10);
  EXPECT_EQ(play_pair(copy, registry.make("random(0.5)"), sampling).method, Method::sampled);
  sampling.noise = 0.1;
  EXPECT_EQ(play_pair(copy, registry.make("pavlov"), sampling).method, Method::sampled);
}

TEST(SampledPlay, TheTournamentKnowsWhoBelievesWhatIsTrue) {
  TournamentSettings settings;
  settings.criterion = Criterion::finite(10);
  auto roster = Registry::standard().roster("all_d,per_cd,tit_for_tat");
  roster.push_back(mirror(std::make_shared<Diary>(), true, true));
  roster.back().caveat = "a toy";
  roster.push_back(roster.back());
  roster.back().name = "its twin";
  const auto tournament = play_tournament(roster, 3, settings);
  EXPECT_TRUE(tournament.has_beliefs());
  EXPECT_EQ(tournament.caveats(), std::vector<std::string>{"a toy"});
  EXPECT_FALSE(tournament.guesses(0, 3).accuracy());
  EXPECT_FALSE(tournament.guesses(0, 3).mean_log_loss());
  EXPECT_DOUBLE_EQ(*tournament.guesses(3, 0).accuracy(), 0.9);
  EXPECT_DOUBLE_EQ(*tournament.guesses(3, 1).accuracy(), 0.1);
  // It gives C 0.5 after a C and 0.1 after a D.
  EXPECT_NEAR(*tournament.guesses(3, 0).mean_log_loss(), -(std::log(0.5) + 9 * std::log(0.9)) / 10, 1e-15);
  EXPECT_DOUBLE_EQ(*tournament.guesses(3, 3).accuracy(), 1);
  EXPECT_DOUBLE_EQ(*tournament.guesses(3, 4).accuracy(), 1);
  for (const auto& entry : tournament.ranking()) {
    const bool believes = entry.entrant >= 3;
    EXPECT_EQ(entry.guesses.accuracy().has_value(), believes);
    EXPECT_DOUBLE_EQ(entry.guesses.accuracy().value_or(0.8), (9 + 1 + 10 + 10 + 10) / 50.0);
    EXPECT_EQ(entry.method, believes ? Method::played : entry.method);
    long double against = 0;
    for (std::size_t j = 0; j < 3; ++j)
      if (j != entry.entrant) against += static_cast<long double>(tournament.score(entry.entrant, j));
    EXPECT_EQ(entry.total_against_roster, against);
  }
  // Two that tie exactly share their rank.
  EXPECT_EQ(tournament.ranking()[0].total == tournament.ranking()[1].total,
            tournament.ranking()[0].rank == tournament.ranking()[1].rank);
  // Beliefs are part of what was computed.
  for (auto& strategy : roster)
    if (!strategy.machine) strategy.make_player = [make = opaque("tit_for_tat").make_player] { return make(); };
  const auto without = play_tournament(roster, 3, settings);
  EXPECT_FALSE(without.has_beliefs());
  EXPECT_EQ(without.score(3, 1), tournament.score(3, 1));
  EXPECT_NE(without.signature(), tournament.signature());
}

TEST(SampledPlay, WithoutSelfPlayNobodyMeetsItself) {
  TournamentSettings settings;
  settings.self_play = false;
  const auto diary = std::make_shared<Diary>();
  const auto tournament = play_tournament(with_classics(mirror(diary, true, true)), settings);
  EXPECT_FALSE(tournament.played(18, 18));
  for (const auto& entry : tournament.ranking())
    EXPECT_NEAR(static_cast<double>(entry.total), static_cast<double>(entry.total_against_roster), 1e-9)
        << "there are no guests";
}

}  // namespace
}  // namespace folk
