#include "made_play.h"
#include "strategies/named.h"

#include <folk/analysis/judgement/own_judgement.h>
#include <folk/games/random.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace folk {
namespace {

Candidates candidates(const std::string& spec, std::uint64_t rounds = 100) {
  return candidates_of(read_weighted_roster(Registry::standard(), spec, {}), rounds);
}

TEST(Candidates, ThatAnswerAlikeAreOne) {
  const auto found = candidates("tit_for_tat,spiteful,mem11_cCDCD,3*mem11_cCDDD,soft_majo,memory(2,2)");
  ASSERT_EQ(found.behaviours.size(), 4U);  // spiteful forgives a slip of its own nowhere, mem11_cCDDD does
  EXPECT_EQ(found.behaviours[0].names(), "mem11_cCDDD");
  EXPECT_EQ(found.behaviours[0].weight, 3);
  EXPECT_EQ(found.behaviours[1].names(), "tit_for_tat = mem11_cCDCD");
  EXPECT_EQ(found.behaviours[1].weight, 2);
  ASSERT_EQ(found.classes.size(), 1U);
  EXPECT_EQ(found.weights().back(), std::ldexp(1.0, 18));
}

TEST(Candidates, LeaveOutPlayersOfUnknownChances) {
  auto prior = read_weighted_roster(Registry::standard(), "pavlov,exec:\"cat\",exec(\"true\";deterministic)", {});
  EXPECT_EQ(leave_out_unpredictable(prior).size(), 1U);
  EXPECT_EQ(prior.known.size(), 2U);
}

TEST(OwnJudgement, ListsWhoAgreesAndRanksTheOthers) {
  const std::vector matches{test::match_of("CCDCC", "CDCCC"), test::match_of("CD", "DC")};
  const auto found = candidates("all_c,tit_for_tat,gtft(0.5),tf2t,1*memory(1,1)");
  const auto judgement = judge_own(found, matches, {0, 0.1}, {}, 2);
  EXPECT_EQ(judgement.consistent(), (std::vector<std::size_t>{1, 2}));
  EXPECT_EQ(judgement.class_agreements[0].consistent(), 2);  // what follows DD is free
  const auto ranking = judgement.ranking();
  EXPECT_EQ(ranking[0], 1U);
  EXPECT_EQ(judgement.posterior.likeliest_slip[1], 0U);
  EXPECT_EQ(judge_own(found, matches, {0, 0.1}, {}, 1).posterior.candidates, judgement.posterior.candidates);
}

/// Plays of known strategies with slips of 0 to 0.1, each 50 rounds or more of one match with somebody who tries
/// everything. Where others could have played just the same they are as likely, and count as found.
TEST(OwnJudgement, FindsWhoPlayed) {
  constexpr std::uint64_t plays = 1000;  // also under sanitizers: a share of 95 % is not seen in fewer
  const auto found = candidates(
      "classics,grudger,spiteful_cc,tft_spiteful,winner12,winner21,axelrod_alternator,axelrod_spiteful_cc,"
      "axelrod_winner21,mathieu_spiteful,gradual_soft,mem2_sct,mem11_cCDCD",
      70);
  std::uint64_t right = 0;
  std::string wrong;
  for (std::uint64_t play = 0; play < plays; ++play) {
    RandomStream random({1, play, 0, 5});
    const std::size_t truth = play % found.behaviours.size();
    const auto& strategies = found.behaviours[truth].strategies;
    const auto& strategy = strategies[random() % strategies.size()];
    const double slip = 0.1 * random.uniform() * (play % 11 == 0 ? 0 : 1);
    const auto explorer = test::named(random() % 2 == 0 ? "random(0.5)" : "random(0.8)");
    const std::vector matches{test::played(strategy, explorer, 50 + random() % 21, slip, play)};
    const auto judgement = judge_own(found, matches, usual_slips(), {}, 1);
    const auto& posterior = judgement.posterior.candidates;
    const auto first = judgement.ranking().front();
    if (posterior[truth] >= posterior[first] * (1 - 1e-9))
      ++right;
    else
      wrong += fmt::format("{} slipping at {:.3f} taken for {}: {:.3f} for {:.3f}\n", strategy.name, slip,
                           found.behaviours[first].names(), posterior[truth], posterior[first]);
  }
  EXPECT_GE(static_cast<double>(right), 0.95 * static_cast<double>(plays)) << wrong;
  RecordProperty("right", std::to_string(right));
}

}  // namespace
}  // namespace folk
