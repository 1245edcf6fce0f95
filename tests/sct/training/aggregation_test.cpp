#include <folk/analysis/replies/bayes_player.h>
#include <folk/analysis/replies/finite_best_reply.h>
#include <folk/games/error.h>
#include <folk/sct/training/aggregation.h>
#include <folk/strategies/registry.h>

#include <gtest/gtest.h>

#include <numeric>

namespace folk::sct {
namespace {

const std::vector<Strategy>& roster() {
  static const auto strategies = Registry::standard().roster("all_c,all_d,tit_for_tat,spiteful,per_ccd");
  return strategies;
}

double total(const std::vector<Trajectory>& data) {
  double sum = 0;
  for (const auto& match : data) sum = std::accumulate(match.rewards.begin(), match.rewards.end(), sum);
  return sum;
}

TEST(Aggregation, TheTeacherAgreesWithTheBayesOptimalPlayer) {
  const BayesTeacher teacher(roster(), {}, 20, 300);
  const auto data = play_and_record(bayes_strategy("bayes", roster(), std::nullopt), roster(), {}, 20, 0, 1, 1);
  ASSERT_EQ(data.size(), roster().size());
  EXPECT_DOUBLE_EQ(total(data), teacher.reply().value());
  for (const auto& match : data) {
    const auto lesson = teacher.label(match);
    EXPECT_EQ(lesson.wanted, lesson.own);
    for (std::size_t t = 0; t < match.rounds(); ++t) {
      const double earned = std::accumulate(match.rewards.begin(), match.rewards.begin() + static_cast<int>(t), 0.0);
      EXPECT_FLOAT_EQ(lesson.returns[t], static_cast<float>(300 - earned));
      EXPECT_GE(lesson.weights[t], 0);
      EXPECT_LE(lesson.weights[t], BayesTeacher::most_weight);
    }
  }
}

TEST(Aggregation, AWrongMoveIsLabelledByTheRightOne) {
  const BayesTeacher teacher(Registry::standard().roster("all_d"), {}, 3, 3);
  const Trajectory sucker{"x", "all_d", {Move::C, Move::C, Move::C}, {Move::D, Move::D, Move::D}, {0, 0, 0}};
  const auto lesson = teacher.label(sucker);
  EXPECT_EQ(lesson.own, (std::vector<std::uint8_t>{0, 0, 0}));
  EXPECT_EQ(lesson.wanted, (std::vector<std::uint8_t>{1, 1, 1}));
  EXPECT_EQ(lesson.weights, (std::vector<float>{1, 1, 1}));
  EXPECT_EQ(lesson.returns, (std::vector<float>{3, 3, 3}));
}

TEST(Aggregation, PlayOfNobodyInTheRosterIsRefused) {
  const BayesTeacher teacher(Registry::standard().roster("all_d"), {}, 3, 3);
  EXPECT_THROW(teacher.label({"x", "all_c", {Move::C, Move::C}, {Move::C, Move::C}, {3, 3}}), UsageError);
}

TEST(Aggregation, BestRepliesEarnTheOptimum) {
  const auto data = best_reply_data(roster(), {}, 50);
  double optimum = 0;
  for (const auto& member : roster()) optimum += FiniteBestReply(*member.machine, {}, 50).optimum();
  EXPECT_DOUBLE_EQ(total(data), optimum);
}

TEST(Aggregation, SlipsAreThePlayersOwnAndDependOnTheirKeyAlone) {
  const auto player = Registry::standard().make("all_c");
  const auto play = [&](std::uint64_t seed) { return play_and_record(player, roster(), {}, 200, 0.1, 3, seed); };
  const auto data = play(1);
  ASSERT_EQ(data.size(), 3 * roster().size());
  EXPECT_EQ(data, play(1));
  EXPECT_NE(data, play(2));
  EXPECT_NE(data[0], data[1]);
  std::size_t slips = 0;
  for (const auto& match : data)
    for (const Move own : match.own) slips += own == Move::D ? 1U : 0U;
  EXPECT_NEAR(static_cast<double>(slips), 300, 5 * std::sqrt(270.0));
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(data[i].theirs, std::vector<Move>(200, Move::C)) << "all_c does not slip";
}

}  // namespace
}  // namespace folk::sct
