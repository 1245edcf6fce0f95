#include <folk/games/error.h>
#include <folk/sct/data/regret_weights.h>
#include <gtest/gtest.h>

#include <cmath>

#include "games/expect_error.h"

namespace folk::sct {
namespace {

Trajectory match(const char* opponent, const char* own, const char* theirs, std::vector<double> rewards) {
  Trajectory trajectory{"", opponent, {}, {}, {}};
  for (std::size_t t = 0; t < rewards.size(); ++t)
    trajectory.add(own[t] == 'C' ? Move::C : Move::D, theirs[t] == 'C' ? Move::C : Move::D, rewards[t]);
  return trajectory;
}

std::vector<Lesson> weighed(const std::vector<Trajectory>& data, const RegretTemperatures& temperatures) {
  std::vector<Lesson> lessons;
  for (const auto& trajectory : data) lessons.push_back(imitation(trajectory));
  weigh_by_regret(data, temperatures, lessons);
  return lessons;
}

TEST(RegretWeights, FollowTheirFormula) {
  // Three matches against one opponent: two open alike and part in round 2, the third opens otherwise.
  const auto lessons =
      weighed({match("x", "CC", "CC", {3, 3}), match("x", "CD", "CC", {3, 5}), match("x", "DD", "CD", {5, 1})}, {2, 4});
  // Round 1: earned 6, 8, 6; best C 8, best D 6.
  const double sum = std::exp(-1.0) + 1 + std::exp(-1.0);
  EXPECT_NEAR(lessons[0].weights[0], std::sqrt(2.0) * std::exp(-1.0) / sum, 1e-6);
  EXPECT_NEAR(lessons[1].weights[0], std::sqrt(2.0) / sum, 1e-6);
  EXPECT_NEAR(lessons[2].weights[0], std::sqrt(2.0) * std::exp(-1.0) / sum, 1e-6);
  // Round 2: after CC two matches with a choice; after DC one alone, two points behind the best of all.
  EXPECT_NEAR(lessons[0].weights[1], std::sqrt(2.0) * std::exp(-1.0) / (std::exp(-1.0) + 1), 1e-6);
  EXPECT_NEAR(lessons[1].weights[1], std::sqrt(2.0) / (std::exp(-1.0) + 1), 1e-6);
  EXPECT_NEAR(lessons[2].weights[1], std::exp(-0.5), 1e-6);
}

TEST(RegretWeights, MatchesOfDifferentLengthsAndOpponentsStandApart) {
  const auto lessons =
      weighed({match("x", "C", "C", {3}), match("y", "CC", "CC", {3, 3}), match("y", "", "", {})}, {1, 1});
  EXPECT_EQ(lessons[0].weights, std::vector<float>{1});
  EXPECT_EQ(lessons[1].weights, (std::vector<float>{1, 1}));
  EXPECT_TRUE(lessons[2].weights.empty());
}

TEST(RegretWeights, AskForTheOpponentsNames) {
  for (const char* name : {"", "x"})
    test::expect_error<UsageError>(
        [&] {
          weighed({match(name, "C", "C", {3}), match("", "D", "C", {5})}, {1, 1});
        },
        *name == '\0' ? "match 0 does not name its opponent" : "match 1 does not name its opponent");
}

}  // namespace
}  // namespace folk::sct
