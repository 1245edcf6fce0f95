#include "analysis/beliefs/believing_player.h"
#include "analysis/play/naive.h"
#include "strategies/named.h"

#include <folk/analysis/equilibria/examination.h>
#include <folk/analysis/equilibria/settlement.h>
#include <folk/games/error.h>
#include <games/expect_error.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace folk {
namespace {

using test::named;
using test::roster;

ExaminationQuestion settling_question(Strategy policy, const char* opponents, const char* criterion,
                                      const char* beliefs) {
  ExaminationQuestion question;
  question.criterion = Criterion::parse(criterion);
  question.policy = std::move(policy);
  question.opponents = roster(opponents);
  question.beliefs = roster(beliefs);
  return question;
}

/// By the definition: asks from each of these rounds on, and takes the least from which on none is refuted.
SettledNotions by_definition(ExaminationQuestion question, std::uint64_t rounds) {
  SettledNotions settled{};
  for (question.from = rounds; question.from > 0; --question.from) {
    const auto verdicts = examine(question).pairs.front().verdicts;
    for (std::size_t n = 0; n < verdicts.size(); ++n) {
      if (question.from == rounds && verdicts[n]) settled[n] = Settled{rounds + 1, Verdict::certified};
      if (!settled[n] || settled[n]->from != question.from + 1) continue;
      if (!verdicts[n] || verdicts[n]->verdict == Verdict::refuted) continue;
      settled[n]->from = question.from;
      if (verdicts[n]->verdict == Verdict::not_refuted) settled[n]->verdict = Verdict::not_refuted;
    }
  }
  for (auto& notion : settled)
    if (notion && *notion->from > rounds) notion = Settled{};
  return settled;
}

bool same(const SettledNotions& a, const SettledNotions& b) {
  for (std::size_t n = 0; n < a.size(); ++n)
    if (a[n].has_value() != b[n].has_value() || (a[n] && (a[n]->from != b[n]->from || a[n]->verdict != b[n]->verdict)))
      return false;
  return true;
}

TEST(Settlement, IsTheLeastRoundByDefinitionInRandomPairs) {
  RandomStream random({21});
  std::size_t late = 0;
  for (const char* criterion : {"finite:9", "discounted:0.7", "mean"})
    for (int pair = 0; pair < 25; ++pair) {
      ExaminationQuestion question;
      question.criterion = Criterion::parse(criterion);
      const auto random_strategy = [&](const char* name, std::uint32_t most) {
        return Strategy{name, std::make_shared<Automaton>(test::random_automaton(random, most, true)), nullptr};
      };
      question.policy = random_strategy("policy", 4);
      question.opponents = {random_strategy("opponent", 4)};
      question.beliefs = {random_strategy("a", 2), random_strategy("b", 2), random_strategy("c", 3)};
      const auto found = settlement(question);
      // Without an end as many rounds as there may be joint states, and some laps more.
      const std::uint64_t rounds = question.criterion.is_finite() ? 9 : 40;
      ASSERT_TRUE(same(found.pairs.front(), by_definition(question, rounds))) << criterion << " " << pair;
      EXPECT_TRUE(same(found.pairs.front(), found.all));
      for (const auto& notion : found.all) late += notion && notion->from && *notion->from > 1 ? 1U : 0U;
    }
  EXPECT_GT(late, 20U);
}

TEST(Settlement, ByHand) {
  // Exploited once, then D for ever.
  auto found = settlement(settling_question(named("spiteful"), "all_d,spiteful", "discounted:0.9", "classics"));
  EXPECT_EQ(found.pairs[0][place_of(Notion::nash)]->from, 2U);
  EXPECT_EQ(found.pairs[0][place_of(Notion::subgame_perfect)]->from, 2U);
  EXPECT_EQ(found.pairs[1][place_of(Notion::nash)]->from, 1U);
  EXPECT_EQ(found.all[place_of(Notion::nash)]->from, 2U);
  EXPECT_EQ(found.all[place_of(Notion::nash)]->verdict, Verdict::certified);
  EXPECT_FALSE(found.all[place_of(Notion::beliefs)]);
  // C, C to the end: D gains in the last round, however late one asks.
  found = settlement(settling_question(named("pavlov"), "pavlov,all_d", "finite:20", "pavlov"));
  EXPECT_EQ(found.pairs[0][place_of(Notion::self_confirming_unrestricted)]->from, std::nullopt);
  EXPECT_EQ(found.all[place_of(Notion::self_confirming_unrestricted)]->from, std::nullopt);
}

TEST(Settlement, OfPlayersWithBeliefs) {
  // It expects the word ccd and meets C, C, C, ...: right but in rounds 3, 6, 9. It plays C throughout, and where it
  // plays D in the last rounds instead it would gain by what it expects; so own beliefs never settle.
  auto question = settling_question(test::believer("all_c", "per_ccd"), "all_c,all_d", "finite:10", "classics");
  auto found = settlement(question);
  EXPECT_EQ(found.pairs[0][place_of(Notion::beliefs)]->from, 10U);
  EXPECT_EQ(found.pairs[1][place_of(Notion::beliefs)]->from, std::nullopt);  // C is expected in round 10
  EXPECT_EQ(found.all[place_of(Notion::beliefs)]->from, std::nullopt);
  EXPECT_EQ(found.pairs[0][place_of(Notion::self_confirming_own)]->from, std::nullopt);
  EXPECT_EQ(found.pairs[0][place_of(Notion::nash)]->from, std::nullopt);
  // It plays D from round 4 on, and expects D: until then a D would have gained by what it believes.
  question.policy =
      test::believer("mem33_cccDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDD", "all_d");
  found = settlement(question);
  EXPECT_EQ(found.pairs[1][place_of(Notion::self_confirming_own)]->from, 4U);
  EXPECT_EQ(found.pairs[1][place_of(Notion::self_confirming_own)]->verdict, Verdict::not_refuted);
  EXPECT_EQ(found.pairs[1][place_of(Notion::beliefs)]->from, 1U);
  EXPECT_EQ(found.pairs[1][place_of(Notion::nash)]->from, 4U);
  EXPECT_EQ(found.pairs[1][place_of(Notion::nash)]->verdict, Verdict::not_refuted);  // the opponent's reply is a search
  EXPECT_EQ(found.pairs[0][place_of(Notion::beliefs)]->from, std::nullopt);
  question.opponents = roster("all_d");
  EXPECT_TRUE(same(settlement(question).pairs.front(), by_definition(question, 10)));
}

TEST(Settlement, OfWhoPlansIsByDefinitionToo) {
  std::size_t late = 0;
  for (const char* own : {"per_ccd", "mem33_cccDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDD"})
    for (const char* opponent : {"all_d", "pavlov", "tit_for_tat"}) {
      auto question = settling_question(test::believer(own, "tit_for_tat"), opponent, "finite:9", "classics");
      question.policy.plans_ahead = 2;  // it says so; what it plays are no plans
      const auto found = settlement(question).pairs.front();
      EXPECT_TRUE(same(found, by_definition(question, 9))) << own << " against " << opponent;
      const auto& settled = found[place_of(Notion::self_confirming_own)];
      ASSERT_TRUE(settled);
      late += settled->from && *settled->from > 1 ? 1U : 0U;
    }
  EXPECT_GT(late, 0U);
}

TEST(Settlement, RefusesWhatItCannotLookThrough) {
  auto question = settling_question(named("pavlov"), "all_d,random(0.5)", "finite:1", "all_d");
  EXPECT_THROW(settlement(question), UsageError);
  question = settling_question(named("pavlov"), "all_d", "finite:1001", "all_d");
  test::expect_error<UsageError>([&] { settlement(question); }, "more rounds than the 1000");
  question.criterion = Criterion::parse("discounted:0.9");
  question.opponents = roster("soft_majo");
  test::expect_error<UsageError>([&] { settlement(question); }, "without end");
  question.opponents = roster("per_ccd");
  question.beliefs = roster("per_ccccccd,per_cccccccd,per_cccccccccd,per_ccccccccccd");  // 7 x 8 x 10 x 11
  test::expect_error<UsageError>([&] { settlement(question); }, "do not repeat within 1000 rounds");
  question.beliefs = roster("soft_majo,per_ccd");  // who has no end is left out
  EXPECT_NO_THROW(settlement(question));
}

}  // namespace
}  // namespace folk
