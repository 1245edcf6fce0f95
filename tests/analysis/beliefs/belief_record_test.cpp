#include <analysis/beliefs/believing_player.h>
#include <folk/analysis/beliefs/belief_record.h>
#include <folk/analysis/play/sampled_play.h>
#include <folk/games/error.h>
#include <games/ended_work.h>
#include <games/expect_error.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "strategies/named.h"

namespace folk {
namespace {

using test::believer;
using test::expect_error;
using test::roster;

Sampling over(std::uint64_t rounds, std::uint64_t repetitions = 3) {
  Sampling sampling;
  sampling.criterion = Criterion::finite(rounds);
  sampling.repetitions = repetitions;
  return sampling;
}

TEST(BeliefRecord, HoldsMovesBeliefsAndTheTruth) {
  const auto records = record_beliefs(believer("all_d", "tit_for_tat"), roster("tit_for_tat,all_c"), over(3));
  ASSERT_EQ(records.size(), 2U);
  EXPECT_EQ(records[0].opponent, "tit_for_tat");
  EXPECT_TRUE(records[0].once);
  ASSERT_EQ(records[0].matches.size(), 1U);
  const BeliefMatch against_tft{{Move::D, Move::C, 1.0, 1}, {Move::D, Move::D, 0.0, 0}, {Move::D, Move::D, 0.0, 0}};
  EXPECT_EQ(records[0].matches[0], against_tft);
  const BeliefMatch against_all_c{{Move::D, Move::C, 1.0, 1}, {Move::D, Move::C, 0.0, 1}, {Move::D, Move::C, 0.0, 1}};
  EXPECT_EQ(records[1].matches[0], against_all_c);
}

TEST(BeliefRecord, OfAMachineHasNoBeliefs) {
  const auto records = record_beliefs(roster("all_c")[0], roster("all_d"), over(2));
  const BeliefMatch match{{Move::C, Move::D, std::nullopt, 0}, {Move::C, Move::D, std::nullopt, 0}};
  EXPECT_EQ(records[0].matches[0], match);
}

TEST(BeliefRecord, TheTruthOfAnOpaqueOpponentIsItsMove) {
  const auto records = record_beliefs(believer("all_c", "all_c"), {believer("tit_for_tat", "all_d")}, over(4));
  for (const auto& round : records[0].matches[0]) EXPECT_EQ(round.truth, 1);
}

TEST(BeliefRecord, SamplesWhereSomebodyMixes) {
  const auto records = record_beliefs(believer("all_c", "all_c"), roster("gtft(0.3),all_d"), over(50, 4));
  EXPECT_FALSE(records[0].once);
  ASSERT_EQ(records[0].matches.size(), 4U);
  EXPECT_EQ(records[1].matches.size(), 1U);
  const auto mixing = record_beliefs(believer("all_c", "all_c"), roster("random(0.25)"), over(50, 4));
  EXPECT_NE(mixing[0].matches[0], mixing[0].matches[1]);
  for (const auto& match : mixing[0].matches)
    for (const auto& round : match) EXPECT_EQ(round.truth, 0.25);
}

/// The keys are those of a tournament: the same match comes out of play_sampled.
TEST(BeliefRecord, DrawsAsTournamentsDo) {
  const auto policy = believer("tit_for_tat", "all_c");
  const auto opponents = roster("random(0.3),random(0.6)");
  const auto records = record_beliefs(policy, opponents, over(40, 1));
  for (std::size_t i = 0; i < opponents.size(); ++i) {
    const auto result = play_sampled({{&policy, &opponents[i], i, false}}, over(40, 1)).front();
    OutcomeWeights counts{};
    for (const auto& round : records[i].matches[0]) counts[round.index()] += 1;
    EXPECT_EQ(counts, result.weights);
  }
}

TEST(BeliefRecord, TellsItsProgress) {
  std::vector<double> shares;
  record_beliefs(believer("all_c", "all_c"), roster("all_c,all_d"), over(5), [&](double s) { shares.push_back(s); });
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_EQ(shares.back(), 1);
}

TEST(BeliefRecord, RefusesWhatHasNoRounds) {
  const auto policy = believer("all_c", "all_c");
  Sampling sampling;
  sampling.criterion = Criterion::mean();
  expect_error<UsageError>([&] { record_beliefs(policy, roster("all_c"), sampling); }, "finite:100");
  sampling = over(10);
  sampling.noise = 0.1;
  expect_error<UsageError>([&] { record_beliefs(policy, roster("all_c"), sampling); }, "noise 0");
  expect_error<UsageError>([&] { record_beliefs(policy, roster("all_c"), over(1'000'000'000)); }, "fewer rounds");
}

TEST(BeliefRecordThreads, EndsAsItsProgressWishes) {
  auto policy = believer("tit_for_tat", "all_c");
  for (const bool together : {false, true}) {
    policy.thinks_together = together;
    for (const unsigned threads : {1U, 4U}) {
      auto sampling = over(6);
      sampling.threads = threads;
      test::expect_ends([&](const Progress& progress) {
        const auto records = record_beliefs(policy, roster("all_c,all_d,random(0.5)"), sampling, progress);
        EXPECT_EQ(records.back().matches.size(), 3U);
      });
    }
  }
}

}  // namespace
}  // namespace folk
