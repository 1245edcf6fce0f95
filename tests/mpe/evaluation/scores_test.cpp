// Means, their intervals and the normalised score.

#include <folk/mpe/evaluation/scores.h>
#include <folk/mpe/players/scripted.h>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "games/expect_error.h"

namespace folk::mpe {
namespace {

TEST(Estimate, OfKnownNumbers) {
  const std::vector<double> values{2, 4, 4, 4, 5, 5, 7, 9};
  const Estimate found = estimate(values);
  EXPECT_DOUBLE_EQ(found.mean, 5);
  EXPECT_DOUBLE_EQ(found.deviation, std::sqrt(32.0 / 7));
  EXPECT_DOUBLE_EQ(found.standard_error, std::sqrt(32.0 / 7 / 8));
  // Student's t of 7 degrees of freedom at 0.975, from a table.
  EXPECT_NEAR(found.ci95, 2.364624 * found.standard_error, 1e-6);
}

TEST(Estimate, OfManyIsNearlyNormal) {
  std::vector<double> values;
  for (int i = 0; i < 20000; ++i) values.push_back(i % 2);
  EXPECT_NEAR(estimate(values).ci95, 1.96 * 0.5 / std::sqrt(20000.0), 1e-6);
}

TEST(Estimate, OfOneValueKnowsNothingOfItsError) {
  const std::vector<double> one{3.5};
  EXPECT_EQ(estimate(one).mean, 3.5);
  EXPECT_TRUE(std::isnan(estimate(one).deviation));
  EXPECT_TRUE(std::isnan(estimate(one).standard_error));
  EXPECT_TRUE(std::isnan(estimate(one).ci95));
  test::expect_error<UsageError>([] { estimate({}); }, "at least one episode");
}

TEST(Summary, IsTheMeanOfEachPart) {
  const std::vector<EpisodeScore> scores{{1, 2, 3, 4, 5, 6, 7}, {3, 6, 9, 12, 15, 18, 21}};
  const ScoreSummary summary = summarise(scores);
  EXPECT_EQ(summary.episodes, 2U);
  EXPECT_EQ(summary.predators.mean, 2);
  EXPECT_EQ(summary.means.predators, 2);
  EXPECT_EQ(summary.means.prey, 4);
  EXPECT_EQ(summary.means.contacts, 6);
  EXPECT_EQ(summary.means.caught_steps, 8);
  EXPECT_EQ(summary.means.distance, 10);
  EXPECT_EQ(summary.means.nearest, 12);
  EXPECT_EQ(summary.means.outside_steps, 14);
}

TEST(References, PublishedOnes) {
  const References tag = published_references(Scenario::named("simple_tag"));
  EXPECT_EQ(tag.expert, 185.6);
  EXPECT_EQ(tag.random, -4.1);
  EXPECT_EQ(to_string(tag.source), "published");
  const References world = published_references(Scenario::named("simple_world"));
  EXPECT_EQ(world.expert, 79.5);
  EXPECT_EQ(world.random, -6.8);
  test::expect_error<UsageError>([] { published_references(Scenario::named("simple_tag", RewardRule::paper)); },
                                 "program's rewards");
  Scenario other = Scenario::named("simple_tag");
  other.name = "mine";
  test::expect_error<UsageError>([&] { published_references(other); }, "'mine'");
}

TEST(References, MeasuredOnesAreTheScoresOfTheirPlayers) {
  const Layout layout(Scenario::named("simple_world"));
  const EpisodePlan plan{3, 10, 80, 2};
  const auto mean = [&](const Controller& predators) {
    return summarise(score_episodes(layout, {predators, random_player()}, plan)).predators.mean;
  };
  std::vector<double> shares;
  const auto found = measured_references(layout, lead_pursuit(), random_player(), plan,
                                         [&](double share) { shares.push_back(share); });
  EXPECT_EQ(found.expert, mean(lead_pursuit()));
  EXPECT_EQ(found.random, mean(random_player()));
  EXPECT_EQ(to_string(found.source), "measured");
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_EQ(shares.back(), 1);
  const auto without = measured_references(layout, std::nullopt, random_player(), plan);
  EXPECT_FALSE(without.expert);
  EXPECT_EQ(without.random, found.random);
}

TEST(NormalisedScore, IsZeroAtRandomAndAHundredAtTheExpert) {
  const References references{185.6, -4.1, ReferenceSource::given};
  EXPECT_EQ(normalised_score(-4.1, references), 0);
  EXPECT_DOUBLE_EQ(*normalised_score(185.6, references), 100);
  EXPECT_NEAR(*normalised_score(231.7, references), 124.3, 0.05);  // lead pursuit, as published: 124
  EXPECT_EQ(to_string(references.source), "given");
}

TEST(NormalisedScore, NeedsAnExpertThatIsBetterThanNothing) {
  EXPECT_FALSE(normalised_score(1, {std::nullopt, 0}));
  EXPECT_FALSE(normalised_score(1, {2.0, 2.0}));
  EXPECT_FALSE(normalised_score(1, {std::nan(""), 2.0}));
}

TEST(ScoreSignature, IsOfEveryReturnInItsPlace) {
  std::vector<EpisodeScore> scores(3);
  const auto zero = signature(scores);
  scores[1].predators = 1;
  const auto one = signature(scores);
  EXPECT_NE(one, zero);
  std::swap(scores[1], scores[2]);
  EXPECT_NE(signature(scores), one);
  scores[2].predators = 0;
  scores[2].prey = 1;
  EXPECT_NE(signature(scores), zero);
  EXPECT_NE(signature(scores), one);
}

TEST(ScoreSignature, DoesNotDependOnThreads) {
  const Layout layout(Scenario::named("simple_tag"));
  const auto of = [&](unsigned threads) {
    return signature(score_episodes(layout, {lead_pursuit(), random_player()}, {1, 0, 300, threads}));
  };
  EXPECT_EQ(of(1), of(4));
}

}  // namespace
}  // namespace folk::mpe
