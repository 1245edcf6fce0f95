#include <fmt/format.h>
#include <folk/analysis/classes/class_tournament.h>
#include <folk/games/error.h>

#include <analysis/classes/naive_class.h>
#include <cases.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <random>
#include <sstream>
#include <string>

namespace folk {
namespace {

using test::listed;
using test::naive_match;

ClassSettings settings_of(const char* criterion, const Payoffs& payoffs = {}) {
  ClassSettings settings;
  settings.payoffs = payoffs;
  settings.criterion = Criterion::parse(criterion);
  return settings;
}

/// One member against all, pair by pair.
void expect_brute_force(const ClassTournament& tournament, const std::vector<CycleTable>& tables, std::size_t member) {
  const auto& settings = tournament.settings();
  const MatchRules rules{settings.payoffs, settings.criterion};
  CycleFinder finder;
  double total = 0;
  double cooperations = 0;
  std::int64_t wins = 0;
  std::int64_t draws = 0;
  for (std::size_t other = 0; other < tables.size(); ++other) {
    if (other == member && !settings.self_play) continue;
    const auto match = naive_match(finder, tables[member], tables[other], rules);
    total += match.own;
    cooperations += match.cooperations;
    wins += match.wins() ? 1 : 0;
    draws += match.draws() ? 1 : 0;
  }
  const std::string name = tournament.name(member);
  if (settings.criterion.is_finite()) {
    EXPECT_EQ(static_cast<double>(tournament.total(member)), total) << name;
  } else {
    EXPECT_NEAR(static_cast<double>(tournament.total(member)), total, 1e-9 * total) << name;
  }
  const double all = settings.criterion.total_weight() * static_cast<double>(tournament.opponents());
  EXPECT_NEAR(tournament.mean(member), total / all, 1e-9) << name;
  EXPECT_NEAR(tournament.cooperation_rate(member), cooperations / all, 1e-9) << name;
  EXPECT_EQ(tournament.totals(member).wins, wins) << name;
  EXPECT_EQ(tournament.totals(member).draws, draws) << name;
}

TEST(ClassTournament, GivesTheTotalsOfPairsPlayedOneByOne) {
  for (const auto& [own, theirs] : {std::pair{1U, 1U}, {1U, 2U}, {2U, 1U}, {0U, 3U}, {3U, 0U}, {0U, 1U}, {1U, 0U}}) {
    const MemoryClass members(own, theirs);
    const auto tables = listed(members);
    for (const char* criterion :
         {"finite:1000", "finite:1", "finite:2", "finite:3", "finite:7", "mean", "discounted:0.9", "ending:0.01"})
      for (const bool self_play : {true, false}) {
        ClassSettings settings = settings_of(criterion);
        settings.self_play = self_play;
        const ClassTournament tournament = play_class(members, settings);
        ASSERT_EQ(tournament.size(), tables.size());
        const std::size_t step = 1 + tables.size() / test::cases(10);
        for (std::size_t member = 0; member < tables.size(); member += step)
          expect_brute_force(tournament, tables, member);
      }
  }
}

TEST(ClassTournament, CountsLongMatchesExactly) {
  const MemoryClass members(1, 2);
  const auto tables = listed(members);
  for (const char* criterion : {"finite:1000000000", "finite:1000000007"})
    expect_brute_force(play_class(members, settings_of(criterion)), tables, 700);
  // Payoffs of some more digits leave the whole numbers of doubles, and 64-bit integers take over.
  const Payoffs fine = prisoners_dilemma(parse_rational("5.123"), parse_rational("3.001"), 1, 0);
  const ClassTournament longest = play_class(members, settings_of("finite:800000000000", fine));
  CycleFinder finder;
  double total = 0;
  for (const auto& other : tables)
    total += naive_match(finder, tables[700], other, {fine, longest.settings().criterion}).own;
  EXPECT_NEAR(static_cast<double>(longest.total(700)), total, 1e-13 * total);
  const auto last = [&](const char* criterion) {
    return play_class(members, settings_of(criterion, fine)).totals(700).score;
  };
  // From the first cycle on a cycle more brings the same: 720720 rounds are a multiple of every cycle's length.
  EXPECT_EQ(longest.totals(700).score - last("finite:799999279280"),
            last("finite:400000720720") - last("finite:400000000000"));
}

TEST(ClassTournament, AgreesWithSampledPairsInTheLargestClass) {
  const MemoryClass members(2, 2);
  ClassSettings settings = settings_of("finite:1000");
  settings.threads = 2;
  const ClassTournament tournament = play_class(members, settings);
  const auto& best = tournament.ranking().front();
  EXPECT_EQ(tournament.total(best.member), 854'961'408.0L);
  // A few members here; FOLK_CLASS_MEMBERS=1000 plays as many, some seconds each.
  const char* more = std::getenv("FOLK_CLASS_MEMBERS");
  const int count = more != nullptr ? std::atoi(more) : static_cast<int>(test::cases(5));
  const auto tables = listed(members);
  std::mt19937 random(12);
  expect_brute_force(tournament, tables, best.member);
  for (int i = 1; i < count; ++i) expect_brute_force(tournament, tables, random() % tables.size());
}

TEST(ClassTournament, RanksAsTheReferenceDoes) {
  for (const auto& [own, theirs] : {std::pair{1U, 1U}, {1U, 2U}}) {
    const MemoryClass members(own, theirs);
    const ClassTournament tournament = play_class(members, settings_of("finite:1000"));
    std::ifstream file(fmt::format("{}/tests/data/memory_{}_{}_1000.csv", FOLK_SOURCE_DIR, own, theirs));
    std::string line;
    std::getline(file, line);
    std::size_t place = 0;
    for (; std::getline(file, line); ++place) {
      std::istringstream fields(line);
      std::string rank;
      std::string name;
      std::string total;
      std::string cooperations;
      std::getline(fields, rank, ',');
      std::getline(fields, name, ',');
      std::getline(fields, total, ',');
      std::getline(fields, cooperations, ',');
      ASSERT_LT(place, tournament.size());
      const std::size_t member = tournament.ranking()[place].member;
      EXPECT_EQ(tournament.name(member), name);
      EXPECT_EQ(tournament.total(member), std::stold(total)) << name;
      EXPECT_EQ(tournament.totals(member).cooperations, std::stoll(cooperations)) << name;
    }
    EXPECT_EQ(place, tournament.size());
  }
}

TEST(ClassTournament, EqualBehavioursShareAPlaceAlsoWhereScoresAreRounded) {
  const ClassTournament tournament = play_class(MemoryClass(1, 1), settings_of("discounted:0.83"));
  // dDDDD and dCDDD never cooperate: their entries for own C are never read.
  EXPECT_EQ(tournament.totals(0b11111), tournament.totals(0b10111));
  EXPECT_EQ(tournament.totals(0b11111), tournament.totals(0b10011));
}

TEST(ClassTournament, ThreadsDoNotChangeIt) {
  for (const char* criterion : {"finite:100", "discounted:0.9"}) {
    ClassSettings settings = settings_of(criterion);
    const auto alone = play_class(MemoryClass(2, 1), settings);
    settings.threads = 4;
    EXPECT_EQ(play_class(MemoryClass(2, 1), settings).signature(), alone.signature());
  }
}

TEST(ClassTournament, RefusesWhatItCannotCount) {
  EXPECT_THROW(play_class(MemoryClass(2, 3), {}), UsageError);
  EXPECT_THROW(play_class(MemoryClass(2, 2), settings_of("finite:1000000000000000")), UsageError);
  Progress cancelled([](double) {});
  cancelled.cancel();
  EXPECT_THROW(play_class(MemoryClass(1, 2), {}, cancelled), Cancelled);
}

}  // namespace
}  // namespace folk
