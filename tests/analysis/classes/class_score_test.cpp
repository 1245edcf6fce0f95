#include <folk/analysis/classes/class_score.h>
#include <folk/games/error.h>
#include <folk/strategies/registry.h>

#include <analysis/classes/naive_class.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace folk {
namespace {

using test::listed;
using test::naive_match;

ClassScoreSettings score_settings(const char* criterion) {
  ClassScoreSettings settings;
  settings.criterion = Criterion::parse(criterion);
  return settings;
}

void expect_score_by_pairs(const MemoryClass& members, const std::vector<CycleTable>& tables, const Strategy& entrant,
                           const ClassScoreSettings& settings) {
  const Criterion& criterion = settings.criterion;
  const auto automaton = entrant.machine->finite() ? *tabulate(*entrant.machine, Sense::own_moves_its_own)
                                                   : unroll(*entrant.machine, Sense::own_moves_its_own, 100);
  const CycleTable table(automaton);
  CycleFinder finder;
  double sum = 0;
  double cooperations = 0;
  std::int64_t beats = 0;
  std::int64_t draws = 0;
  double best = -1e300;
  double worst = 1e300;
  std::size_t best_member = 0;
  std::size_t worst_member = 0;
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const auto match = naive_match(finder, table, tables[i], {settings.payoffs, criterion});
    sum += match.own;
    cooperations += match.cooperations;
    beats += match.wins() ? 1 : 0;
    draws += match.draws() ? 1 : 0;
    if (match.own > best + 1e-9) best_member = i;
    if (match.own < worst - 1e-9) worst_member = i;
    best = std::max(best, match.own);
    worst = std::min(worst, match.own);
  }
  const std::string what = entrant.name + " against " + members.name() + ", " + criterion.to_string();
  const ClassScore score = score_against(members, *entrant.machine, settings);
  const double all = static_cast<double>(tables.size()) * criterion.total_weight();
  EXPECT_NEAR(score.mean, sum / all, 1e-12 * sum / all) << what;
  EXPECT_NEAR(score.cooperation_rate, cooperations / all, 1e-12) << what;
  EXPECT_EQ(score.beats, Integer(beats)) << what;
  EXPECT_EQ(score.draws, Integer(draws)) << what;
  EXPECT_EQ(score.beats + score.draws + score.loses, members.size()) << what;
  EXPECT_NEAR(score.best.mean, best / criterion.total_weight(), 1e-12) << what;
  EXPECT_NEAR(score.worst.mean, worst / criterion.total_weight(), 1e-12) << what;
  EXPECT_EQ(score.best.member, members.member(best_member).name()) << what;
  EXPECT_EQ(score.worst.member, members.member(worst_member).name()) << what;
  if (criterion.is_finite()) {
    ASSERT_TRUE(score.exact_mean) << what;
    EXPECT_EQ(*score.exact_mean * Rational(members.size()) * Rational(criterion.rounds()),
              Rational(static_cast<std::int64_t>(sum)))
        << what;
  }
}

TEST(ClassScore, IsThatOfPairsPlayedOneByOne) {
  const auto entrants = Registry::standard().roster("classics,winner12,tft_spiteful,mem21_dcDDDDDCDD");
  for (const auto& [own, theirs] : {std::pair{1U, 1U}, {1U, 2U}, {2U, 1U}, {0U, 3U}}) {
    const MemoryClass members(own, theirs);
    const auto tables = listed(members);
    for (const Strategy& entrant : entrants) {
      for (const char* criterion : {"finite:100", "finite:1", "finite:3"})
        expect_score_by_pairs(members, tables, entrant, score_settings(criterion));
      if (!entrant.machine->finite()) continue;
      for (const char* criterion : {"finite:1000000000", "mean", "discounted:0.9", "ending:0.02"})
        expect_score_by_pairs(members, tables, entrant, score_settings(criterion));
    }
  }
}

// The first and fourth by a program of 40 lines that branches in the same way, written apart from this one.
TEST(ClassScore, AgainstAllOfMemory33) {
  const Registry registry = Registry::standard();
  const auto score = [&](const char* name) {
    return score_against(MemoryClass(3, 3), *registry.make(name).machine, score_settings("finite:1000"));
  };
  EXPECT_EQ(to_text(*score("tit_for_tat").exact_mean), "2.2745798168182373046875");
  EXPECT_EQ(score("tit_for_tat").leaves, 3941U);
  EXPECT_EQ(to_text(*score("pavlov").exact_mean), "2.3538803768157958984375");
  EXPECT_EQ(to_text(*score("spiteful").exact_mean), "2.9971875");
  EXPECT_EQ(to_text(*score("winner12").exact_mean), "2.7222284908294677734375");
  EXPECT_EQ(*score("all_d").exact_mean, Rational(3));
  EXPECT_EQ(*score_against(MemoryClass(3, 3), *registry.make("all_d").machine, score_settings("mean")).exact_mean,
            Rational(3));
}

TEST(ClassScore, ThreadsDoNotChangeIt) {
  for (const char* criterion : {"finite:500", "mean", "discounted:0.95"}) {
    const auto machine = Registry::standard().make("winner12").machine;
    ClassScoreSettings settings = score_settings(criterion);
    const ClassScore alone = score_against(MemoryClass(2, 2), *machine, settings);
    settings.threads = 3;
    const ClassScore together = score_against(MemoryClass(2, 2), *machine, settings);
    EXPECT_EQ(alone.mean, together.mean);
    EXPECT_EQ(alone.exact_mean, together.exact_mean);
    EXPECT_EQ(alone.beats, together.beats);
    EXPECT_EQ(alone.best.member, together.best.member);
    EXPECT_EQ(alone.leaves, together.leaves);
  }
}

TEST(ClassScore, RefusesWhatItCannotGoThrough) {
  const Registry registry = Registry::standard();
  const auto score = [&](const char* name, const ClassScoreSettings& settings) {
    return score_against(MemoryClass(3, 3), *registry.make(name).machine, settings);
  };
  EXPECT_THROW(score("random(0.3)", {}), UsageError);
  EXPECT_THROW(score("gradual", score_settings("mean")), UsageError);
  ClassScoreSettings fine = score_settings("finite:1000000000000000");
  fine.payoffs = prisoners_dilemma(parse_rational("5.1"), 3, 1, 0);
  EXPECT_THROW(score("tit_for_tat", fine), UsageError);
  ClassScoreSettings few;
  few.most_leaves = 20'000;
  EXPECT_THROW(score("per_ddc", few), TooManyKinds);
  Progress cancelled([](double) {});
  cancelled.cancel();
  EXPECT_THROW(score_against(MemoryClass(3, 3), *registry.make("pavlov").machine, {}, cancelled), Cancelled);
}

}  // namespace
}  // namespace folk
