#include <folk/analysis/replies/bayes_player.h>
#include <folk/games/error.h>
#include <folk/sct/data/recorded_play.h>
#include <folk/sct/training/aggregation.h>
#include <folk/strategies/registry.h>

#include <gtest/gtest.h>
#include <sct/data/small_roster.h>

#include <numeric>

namespace folk::sct {
namespace {

using test::roster;
using test::total;

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

}  // namespace
}  // namespace folk::sct
