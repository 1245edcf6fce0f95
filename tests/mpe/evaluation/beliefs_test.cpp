// How often a transformer's beliefs are right, held against plain sums, and the search for the best return to ask for.

#include <folk/mpe/evaluation/beliefs.h>
#include <folk/mpe/players/policy_file.h>
#include <folk/mpe/players/scripted.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "games/expect_error.h"
#include "mpe/players/small_transformer.h"

namespace folk::mpe {
namespace {

using folk::test::expect_error;

/// One that is quick to ask.
std::shared_ptr<const TransformerMind> quick_mind(const testing::TransformerKind& kind = {"teacher_cat"}) {
  return testing::small_mind(kind, "simple_tag", {.context = 4, .layers = 1});
}

constexpr testing::TransformerKind selfconf{"selfconf", sct::LossMode::selfconf};

const Layout& tag() {
  static const Layout layout(Scenario::named("simple_tag"));
  return layout;
}

std::shared_ptr<const TransformerMind> mind_of(TransformerPolicy policy) {
  return std::make_shared<const TransformerMind>(std::move(policy));
}

/// A mind that always believes this, whatever it sees.
std::shared_ptr<const TransformerMind> believer(double x, double y) {
  auto policy = testing::zero_transformer();
  const auto bias = sct::ParameterLayout(policy.architecture)["predict_opoact.bias"].offset;
  policy.parameters[bias] = static_cast<float>(std::atanh(x));
  policy.parameters[bias + 1] = static_cast<float>(std::atanh(y));
  return mind_of(std::move(policy));
}

/// What the prey did, by episode, step after step.
using Deeds = std::map<std::uint64_t, std::vector<Point>>;

class Scribe final : public Watcher {
public:
  explicit Scribe(Deeds& deeds)
      : deeds_(deeds) {}
  void acted(const Layout& layout, const Block& block, const Moment& moment) override {
    const auto [x, y] = action_rows(block, layout.scenario().prey());
    for (std::size_t lane = 0; lane < block.lanes; ++lane) deeds_[moment.first + lane].push_back({x[lane], y[lane]});
  }

private:
  Deeds& deeds_;
};

/// By the definition, one step after the other.
EpisodeBeliefs plain_beliefs(const std::vector<Point>& deeds, const std::vector<ThoughtRecord>& thoughts) {
  EpisodeBeliefs out;
  const double steps = static_cast<double>(deeds.size());
  for (std::size_t t = 0; t < deeds.size(); ++t) {
    const double dx = static_cast<double>(thoughts[t].belief[0]) - deeds[t].x;
    const double dy = static_cast<double>(thoughts[t].belief[1]) - deeds[t].y;
    const double distance = std::sqrt(dx * dx + dy * dy);
    const double size = std::sqrt(deeds[t].x * deeds[t].x + deeds[t].y * deeds[t].y);
    const std::array radii{0.05, 0.1, 0.2, 0.5};
    for (std::size_t r = 0; r < 4; ++r)
      if (distance < radii[r] * (size < 0.1 ? 0.1 : size)) out.right[r] += 1 / steps;
    const std::array distances{0.1, 0.3, 0.6};
    for (std::size_t r = 0; r < 3; ++r)
      if (distance < distances[r]) out.within[r] += 1 / steps;
    out.distance += distance / steps;
    out.change += thoughts[t].change / steps;
  }
  return out;
}

void expect_near(const EpisodeBeliefs& one, const EpisodeBeliefs& other) {
  for (std::size_t r = 0; r < belief_radii.size(); ++r) EXPECT_NEAR(one.right[r], other.right[r], 1e-12) << r;
  for (std::size_t r = 0; r < absolute_radii.size(); ++r) EXPECT_NEAR(one.within[r], other.within[r], 1e-12) << r;
  EXPECT_NEAR(one.distance, other.distance, 1e-12);
  EXPECT_NEAR(one.change, other.change, 1e-12);
}

TransformerPlay with(BeliefForcing forcing) {
  TransformerPlay play;
  play.forcing = forcing;
  return play;
}

/// Plays episodes by hand and expects the scores to say the same; returns the means of what they say.
EpisodeBeliefs expect_plain(const std::shared_ptr<const TransformerMind>& mind, const Controller& prey,
                            BeliefForcing forcing = BeliefForcing::none, std::size_t episodes = 10) {
  const EpisodePlan plan{.seed = 5, .first = 30, .episodes = episodes};
  std::map<std::uint64_t, std::vector<ThoughtRecord>> thoughts;
  TransformerPlay play{
      {}, forcing, prey, [&](const ThoughtRecord& thought) { thoughts[thought.episode].push_back(thought); }};
  const Cast cast{transformer_controller("t", mind, tag().scenario(), play), prey};
  Deeds deeds;
  play_episodes(tag(), cast, plan, [&](std::size_t) { return std::make_unique<Scribe>(deeds); });
  const auto scores = score_transformer(tag(), mind, prey, plan, with(forcing));
  EXPECT_EQ(scores.beliefs.size(), episodes);
  EpisodeBeliefs mean;
  for (std::size_t e = 0; e < episodes; ++e) {
    const auto plain = plain_beliefs(deeds.at(30 + e), thoughts.at(30 + e));
    expect_near(scores.beliefs[e], plain);
    for (std::size_t r = 0; r < belief_radii.size(); ++r)
      mean.right[r] += plain.right[r] / static_cast<double>(episodes);
    for (std::size_t r = 0; r < absolute_radii.size(); ++r)
      mean.within[r] += plain.within[r] / static_cast<double>(episodes);
    mean.distance += plain.distance / static_cast<double>(episodes);
    mean.change += plain.change / static_cast<double>(episodes);
  }
  play.witness = nullptr;
  const auto played = score_episodes(tag(), {transformer_controller("t", mind, tag().scenario(), play), prey}, plan);
  EXPECT_EQ(signature(scores.play), signature(played));
  return mean;
}

TEST(Beliefs, OfNothingAboutAStillPreyAreRightAtEveryRadius) {
  const auto mind = mind_of(testing::zero_transformer());
  for (const auto& episode : score_transformer(tag(), mind, still_player(), {.episodes = 3}, {}).beliefs) {
    for (const double right : episode.right) EXPECT_NEAR(right, 1, 1e-12);
    for (const double within : episode.within) EXPECT_NEAR(within, 1, 1e-12);
    EXPECT_EQ(episode.distance, 0);
    EXPECT_EQ(episode.change, 0);
  }
}

TEST(Beliefs, HaveARadiusInUnitsOfTheActionButOfATenthAtLeast) {
  // The prey is still; a belief of size 0.03 is right at radius r when 0.03 < 0.1 r.
  const auto about_still = [](double belief) {
    return score_transformer(tag(), believer(0, belief), still_player(), {.episodes = 1}, {}).beliefs.front();
  };
  const auto close = about_still(0.03);
  EXPECT_NEAR(close.right[0], 0, 1e-12);
  EXPECT_NEAR(close.right[1], 0, 1e-12);
  EXPECT_NEAR(close.right[2], 0, 1e-12);
  EXPECT_NEAR(close.right[3], 1, 1e-12);
  EXPECT_NEAR(close.within[0], 1, 1e-12);
  EXPECT_NEAR(close.distance, 0.03, 1e-6);
  EXPECT_NEAR(about_still(0.0149).right[2], 1, 1e-12);
  EXPECT_NEAR(about_still(0.0099).right[paper_radius], 1, 1e-12);
  EXPECT_NEAR(about_still(0.0101).right[paper_radius], 0, 1e-12);
  EXPECT_NEAR(about_still(0.0049).right[0], 1, 1e-12);
  EXPECT_NEAR(about_still(0.099).within[0], 1, 1e-12);
  EXPECT_NEAR(about_still(0.101).within[0], 0, 1e-12);
  EXPECT_NEAR(about_still(0.299).within[1], 1, 1e-12);
  EXPECT_NEAR(about_still(0.301).within[1], 0, 1e-12);
  EXPECT_NEAR(about_still(0.599).within[2], 1, 1e-12);
  EXPECT_NEAR(about_still(0.601).within[2], 0, 1e-12);
  EXPECT_EQ(belief_radii[paper_radius], 0.1);
}

TEST(Beliefs, AreCountedAsDefined) {
  const auto zero = expect_plain(mind_of(testing::zero_transformer()), random_player(), BeliefForcing::none, 70);
  EXPECT_LT(zero.right[3], 0.01);  // a random prey is hardly ever still
  EXPECT_NEAR(zero.within[2], 0.36 * 3.14159 / 4, 0.04);
  EXPECT_NEAR(zero.distance, 0.765, 0.02);  // mean distance of a square's points from its middle
  const auto constant = expect_plain(believer(0.6, -0.5), random_player(), BeliefForcing::none, 70);
  for (std::size_t r = 1; r < belief_radii.size(); ++r) EXPECT_GT(constant.right[r], constant.right[r - 1]);
  EXPECT_GT(constant.right[0], 0);
  EXPECT_NEAR(constant.within[0], 0.01 * 3.14159 / 4, 0.006);  // the disc's share of the square
  expect_plain(quick_mind(), random_player(RandomRule::program));
  const auto released = untrained_policy(tag().scenario(), Side::prey, 3, 8);
  expect_plain(quick_mind(selfconf), policy_controller("p", released, Side::prey, tag().scenario()));
}

TEST(Beliefs, HaveTheChangeOfWhatIsForced) {
  const auto prey = random_player();
  for (const auto forcing : {BeliefForcing::truth, BeliefForcing::other_episode, BeliefForcing::zero})
    EXPECT_GT(expect_plain(quick_mind(selfconf), prey, forcing).change, 0.01);
  EXPECT_EQ(expect_plain(quick_mind(selfconf), prey).change, 0);
}

TEST(Beliefs, AreWatchedWhereThePlayCannotBeForced) {
  const auto own = quick_mind({"own", sct::LossMode::teacher, sct::Readout::own});
  EXPECT_EQ(expect_plain(own, random_player()).change, 0);
  expect_error<UsageError>(
      [&] { score_transformer(tag(), own, random_player(), {.episodes = 1}, with(BeliefForcing::truth)); },
      "do not look at the belief token");
}

TEST(BeliefsThreads, ChangeNoBit) {
  const auto scores = [](unsigned threads) {
    return score_transformer(tag(), quick_mind(selfconf), random_player(),
                             {.seed = 2, .episodes = 70, .threads = threads}, with(BeliefForcing::truth));
  };
  const auto one = scores(1);
  const auto three = scores(3);
  EXPECT_EQ(signature(one.play), signature(three.play));
  for (std::size_t e = 0; e < 70; ++e) {
    EXPECT_EQ(one.beliefs[e].right, three.beliefs[e].right);
    EXPECT_EQ(one.beliefs[e].distance, three.beliefs[e].distance);
    EXPECT_EQ(one.beliefs[e].change, three.beliefs[e].change);
  }
}

TEST(BeliefSummary, IsTheEstimateOfEachPart) {
  std::vector<EpisodeBeliefs> episodes(3);
  for (std::size_t e = 0; e < 3; ++e) {
    const double x = static_cast<double>(e + 1);
    for (std::size_t r = 0; r < belief_radii.size(); ++r) episodes[e].right[r] = x * static_cast<double>(r + 1);
    for (std::size_t r = 0; r < absolute_radii.size(); ++r) episodes[e].within[r] = x * static_cast<double>(8 + r);
    episodes[e].distance = 6 * x;
    episodes[e].change = 7 * x;
  }
  const auto summary = summarise(std::span<const EpisodeBeliefs>(episodes));
  for (std::size_t r = 0; r < belief_radii.size(); ++r)
    EXPECT_DOUBLE_EQ(summary.right[r].mean, 2 * static_cast<double>(r + 1));
  for (std::size_t r = 0; r < absolute_radii.size(); ++r)
    EXPECT_DOUBLE_EQ(summary.within[r].mean, 2 * static_cast<double>(8 + r));
  EXPECT_DOUBLE_EQ(summary.distance.mean, 12);
  EXPECT_DOUBLE_EQ(summary.change.mean, 14);
  EXPECT_DOUBLE_EQ(summary.change.deviation, 7);
  expect_error<UsageError>([] { summarise(std::span<const EpisodeBeliefs>()); }, "at least one episode");
}

// ---- which return to ask for -------------------------------------------------------------------------------------

TEST(Targets, AreScoredOnTheSameEpisodes) {
  const auto mind = quick_mind();
  const EpisodePlan plan{.seed = 2, .first = 9, .episodes = 20, .threads = 2};
  const std::vector<double> targets{0, 50, 0, mind->policy.return_target};
  std::vector<double> shares;
  const auto scores =
      score_targets(tag(), mind, random_player(), plan, targets, [&](double share) { shares.push_back(share); });
  ASSERT_EQ(scores.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(scores[i].target, targets[i]);
    TransformerPlay play;
    play.target = targets[i];
    const Cast cast{transformer_controller("t", mind, tag().scenario(), play), random_player()};
    const auto expected = summarise(score_episodes(tag(), cast, plan)).predators;
    EXPECT_EQ(scores[i].predators.mean, expected.mean);
    EXPECT_EQ(scores[i].predators.standard_error, expected.standard_error);
    const auto beliefs = score_transformer(tag(), mind, random_player(), plan, play).beliefs;
    ASSERT_TRUE(scores[i].beliefs.has_value());
    EXPECT_EQ(scores[i].beliefs->distance.mean, summarise(std::span<const EpisodeBeliefs>(beliefs)).distance.mean);
  }
  EXPECT_EQ(scores[0].predators.mean, scores[2].predators.mean);
  EXPECT_NE(scores[0].predators.mean, scores[1].predators.mean);
  const Cast cast{transformer_controller("t", mind, tag().scenario()), random_player()};
  EXPECT_EQ(scores[3].predators.mean, summarise(score_episodes(tag(), cast, plan)).predators.mean);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  ASSERT_FALSE(shares.empty());
  EXPECT_EQ(shares.back(), 1);
}

TEST(Targets, SayNothingOfBeliefsWhereThereAreNone) {
  const auto madt = quick_mind({"madt", sct::LossMode::action_only, sct::Readout::own, false});
  const std::vector<double> targets{3};
  EXPECT_FALSE(score_targets(tag(), madt, random_player(), {.episodes = 2}, targets).front().beliefs.has_value());
}

TEST(Targets, TheBestIsTheFirstOfTheHighest) {
  const auto best = [](const std::vector<std::pair<double, double>>& means) {
    std::vector<TargetScore> scores;
    for (const auto& [target, mean] : means) scores.push_back({target, {mean, 0, 0, 0}, std::nullopt});
    return best_target(scores);
  };
  EXPECT_EQ(best({{7, 1}}), 7);
  EXPECT_EQ(best({{0, 1}, {20, 3}, {40, 2}}), 20);
  EXPECT_EQ(best({{0, 1}, {20, 3}, {40, 3}}), 20);
  EXPECT_EQ(best({{40, 3}, {20, 3}, {0, 1}}), 40);
  EXPECT_EQ(best({{-5, -4}, {5, -3}}), 5);
  expect_error<UsageError>([] { best_target({}); }, "there is no return to ask for: give at least one");
}

// ---- forcing -----------------------------------------------------------------------------------------------------

TEST(Forcing, IsHeldAgainstTheSameEpisodesOnOwnBeliefs) {
  const auto mind = quick_mind(selfconf);
  const EpisodePlan plan{.seed = 2, .first = 9, .episodes = 20, .threads = 2};
  TransformerPlay play;
  play.target = 20;
  std::vector<double> shares;
  const auto rows =
      force_beliefs(tag(), mind, random_player(), plan, play, [&](double share) { shares.push_back(share); });
  const std::vector forcings{BeliefForcing::none, BeliefForcing::truth, BeliefForcing::other_episode,
                             BeliefForcing::zero};
  ASSERT_EQ(rows.size(), forcings.size());
  const auto free = score_transformer(tag(), mind, random_player(), plan, play);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].forcing, forcings[i]);
    auto forced = play;
    forced.forcing = forcings[i];
    const auto scores = score_transformer(tag(), mind, random_player(), plan, forced);
    double difference = 0;
    for (std::size_t e = 0; e < 20; ++e) difference += (scores.play[e].predators - free.play[e].predators) / 20;
    EXPECT_NEAR(rows[i].difference.mean, difference, 1e-9);
    EXPECT_EQ(rows[i].predators.mean, summarise(std::span<const EpisodeScore>(scores.play)).predators.mean);
    EXPECT_EQ(rows[i].change.mean, summarise(std::span<const EpisodeBeliefs>(scores.beliefs)).change.mean);
    EXPECT_EQ(rows[i].change.mean == 0, i == 0);
    EXPECT_EQ(rows[i].difference.mean == 0, i == 0);
  }
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_EQ(shares.back(), 1);
  const auto own = quick_mind({"own", sct::LossMode::teacher, sct::Readout::own});
  expect_error<UsageError>([&] { force_beliefs(tag(), own, random_player(), {.episodes = 2}, {}); },
                           "there is nothing to force");
}

TEST(Forcing, IsRefusedWhereAnEpisodeHasNoOtherBesideIt) {
  const auto forced = [](std::size_t episodes) {
    return force_beliefs(tag(), quick_mind(selfconf), random_player(), {.episodes = episodes}, {});
  };
  expect_error<UsageError>([&] { forced(1); }, "1 episodes: the last one would have no other beside it");
  expect_error<UsageError>([&] { forced(65); }, "65 episodes: the last one would have no other beside it");
  EXPECT_EQ(forced(2).size(), 4U);
}

}  // namespace
}  // namespace folk::mpe
