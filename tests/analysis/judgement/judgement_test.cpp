#include "made_play.h"
#include "strategies/named.h"

#include <folk/analysis/judgement/judgement.h>
#include <gtest/gtest.h>

namespace folk {
namespace {

JudgementQuestion question(std::vector<RecordedMatch> matches) {
  JudgementQuestion asked;
  asked.play.matches = std::move(matches);
  asked.players = read_weighted_roster(Registry::standard(), "classics,1*memory(3,3)", {});
  asked.opponents = read_weighted_roster(Registry::standard(), "classics", {});
  return asked;
}

TEST(Judgement, PutsAllTogether) {
  // Against all_d nothing but D is a best reply to a belief that agrees; C in the first round may be one.
  std::vector matches{test::match_of("DDDD", "DDDD", "a"), test::match_of("CCCC", "CCCC", "b")};
  for (auto& round : matches[0].rounds) round.belief = 0.2;
  matches[1].rounds[0].belief = 0.1;
  const auto found = judge_play(question(matches));
  EXPECT_EQ(found.reading.free, 1U);
  EXPECT_EQ(found.reading.worst, 1U);
  EXPECT_EQ(found.reading.agreed, 2U);
  EXPECT_EQ(found.reading.of_class, 1U);
  EXPECT_EQ(found.reading.stated, 2U);
  EXPECT_EQ(found.reading.right, 1U);
  EXPECT_EQ(found.reading.all, 1U);
  ASSERT_TRUE(found.beliefs);
  EXPECT_EQ(found.beliefs->rounds, 5U);
  EXPECT_EQ(found.beliefs->right, 4U);
  EXPECT_EQ(found.stage->best, 4U);                          // C is never one
  EXPECT_EQ(found.own.class_agreements[0].consistent(), 0);  // the first moves differ
}

TEST(StageReplies, AreByTheBeliefOfTheRound) {
  Payoffs stag_hunt;
  stag_hunt.reward = 4;
  stag_hunt.temptation = 3;
  stag_hunt.punishment = 2;
  stag_hunt.sucker = 1;  // C is as good as D at 1/2
  std::vector matches{test::match_of("CCDD", "CCCC")};
  const double beliefs[] = {0.5, 0.4, 0.5, 0.9};
  for (std::size_t t = 0; t < 4; ++t) matches[0].rounds[t].belief = beliefs[t];
  const auto replies = stage_replies(matches, stag_hunt);
  EXPECT_EQ(replies.rounds, 4U);
  EXPECT_EQ(replies.best, 2U);
  EXPECT_NEAR(replies.loss_sum, 0.2 + 0.8, 1e-12);
  EXPECT_NEAR(replies.largest_loss, 0.8, 1e-12);
}

}  // namespace
}  // namespace folk
