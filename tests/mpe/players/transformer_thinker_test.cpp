// What is thought at play against what the training network says of the windows that training draws.

#include <folk/mpe/offline/transformer_windows.h>
#include <folk/mpe/players/transformer_thinker.h>
#include <folk/sct/training/self_confirming_loss.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "mpe/data/small_data_set.h"
#include "mpe/players/small_transformer.h"

namespace folk::mpe {
namespace {

using testing::small_transformer;
using testing::TransformerKind;
using testing::TransformerSizes;

constexpr float tolerance = 1e-5F;

/// Two episodes of a scenario as data.
const DataSet& recorded(const std::string& scenario) {
  static const auto read = [](const char* name) {
    return test::files_of(test::played_arrays(Layout(Scenario::named(name)), test::pursuit_cast(), 3, 0, 2));
  };
  static const test::Files tag_files = read("simple_tag"), world_files = read("simple_world");
  static const DataSet tag = test::parse(tag_files), world = test::parse(world_files);
  return scenario == "simple_tag" ? tag : world;
}

/// What is seen in a step of a recorded episode.
struct Sight {
  std::vector<float> observations, own;
  std::array<float, 2> prey{};
  float reward = 0;

  Sight(const DataSet& data, std::size_t episode, std::size_t step) {
    const std::size_t row = episode * data.episode_steps() + step;
    const std::size_t size = data.scenario().observation_size(0);
    observations.resize(3 * size);
    own.resize(6);
    for (std::size_t i = 0; i < 3; ++i) data.observation(i, row, std::span(observations).subspan(i * size, size));
    if (step == 0) return;
    for (std::size_t i = 0; i < 3; ++i) data.action(i, row - 1, std::span<float, 2>(own.data() + 2 * i, 2));
    data.action(3, row - 1, prey);
    reward = data.reward(0, row - 1);
  }

  Glimpse glimpse() const { return {observations, reward, prey, own}; }
};

double return_of(const DataSet& data, std::size_t episode) {
  double sum = 0;
  for (std::size_t t = 0; t < data.episode_steps(); ++t)
    sum += static_cast<double>(data.reward(0, episode * data.episode_steps() + t));
  return sum;
}

std::array<float, 2> prey_action(const DataSet& data, std::size_t episode, std::size_t step) {
  std::array<float, 2> action{};
  data.action(3, episode * data.episode_steps() + step, action);
  return action;
}

Matrix<float> one_row(const std::array<float, 2>& numbers) {
  Matrix<float> row(1, 2);
  row << numbers[0], numbers[1];
  return row;
}

/// What a policy thought in a recorded episode, step by step.
struct HeldThoughts {
  std::vector<Matrix<float>> beliefs;
  std::vector<Matrix<float>> actions;           // on these
  std::vector<Matrix<float>> actions_on_truth;  // on what the prey did
};

HeldThoughts think(const TransformerMind& mind, const DataSet& data, std::size_t episode) {
  TransformerThinker thinker(mind, 1, return_of(data, episode));
  HeldThoughts thoughts;
  for (std::size_t t = 0; t < data.episode_steps(); ++t) {
    const Sight sight(data, episode, t);
    const std::array glimpses{sight.glimpse()};
    thoughts.beliefs.push_back(thinker.see(glimpses));
    thoughts.actions_on_truth.push_back(thinker.act(one_row(prey_action(data, episode, t))));
    thoughts.actions.push_back(thinker.act(thoughts.beliefs.back()));
  }
  return thoughts;
}

/// The predictions of the training network on the first rounds of a batch of one window.
sct::Predictions<float> training_pass(const TransformerMind& mind, sct::LossMode mode, const sct::Batch<float>& batch,
                                      std::size_t rounds) {
  sct::SelfConfirmingLoss<float> loss(mind.network, mode);
  const std::array window_rounds{rounds};
  loss(mind.policy.parameters.data(), {batch, 0, 0, window_rounds}, sct::Denominators<float>(batch),
       {sct::Dropout(), sct::Dropout()}, nullptr);
  return loss.predictions();
}

void put(sct::Batch<float>& batch, std::size_t round, const Matrix<float>& belief) {
  for (Index k = 0; k < 2; ++k) batch.opponent.numbers[2 * round + static_cast<std::size_t>(k)] = belief(0, k);
}

void expect_last_row(const Matrix<float>& training, const Matrix<float>& thought, const char* what, std::size_t step) {
  ASSERT_EQ(training.cols(), thought.cols());
  EXPECT_LT((training.bottomRows(1) - thought).cwiseAbs().maxCoeff(), tolerance) << what << " of step " << step;
}

/// `rounds` rounds of a drawn window that begins at step `first`: what was thought in the last of them.
void expect_thoughts(const TransformerMind& mind, const sct::Batch<float>& batch, std::size_t first, std::size_t rounds,
                     const HeldThoughts& thoughts) {
  const std::size_t step = first + rounds - 1;
  const auto mode = mind.policy.mode;
  const auto plain = mode == sct::LossMode::action_only ? mode : sct::LossMode::teacher;
  const auto on_truth = training_pass(mind, plain, batch, rounds);
  if (plain == sct::LossMode::teacher)
    expect_last_row(on_truth.belief, thoughts.beliefs[step], "belief", step);
  else
    EXPECT_EQ(thoughts.beliefs[step], Matrix<float>::Zero(1, 2));
  auto believing = batch;
  auto truthful = batch;
  if (mode == sct::LossMode::selfconf || mode == sct::LossMode::composite)
    for (std::size_t t = 0; t + 1 < rounds; ++t) {  // as they were held then
      put(believing, t, thoughts.beliefs[first + t]);
      put(truthful, t, thoughts.beliefs[first + t]);
    }
  put(believing, rounds - 1, thoughts.beliefs[step]);
  expect_last_row(training_pass(mind, plain, believing, rounds).action, thoughts.actions[step], "action", step);
  expect_last_row(training_pass(mind, plain, truthful, rounds).action, thoughts.actions_on_truth[step],
                  "action on the truth", step);
}

struct Specimen {
  TransformerKind kind;
  std::size_t context;
  const char* scenario = "simple_tag";
};

std::vector<Specimen> specimens() {
  std::vector<Specimen> all;
  for (const auto& kind : testing::transformer_kinds)
    for (const std::size_t context : {20, 4}) all.push_back({kind, context});
  all.push_back({testing::transformer_kinds[0], 1});
  all.push_back({testing::transformer_kinds[5], 1});
  all.push_back({testing::transformer_kinds[0], 5, "simple_world"});
  all.push_back({testing::transformer_kinds[5], 40, "simple_world"});  // longer than an episode
  return all;
}

class TransformerThinkerTest : public ::testing::TestWithParam<Specimen> {
protected:
  const TransformerMind mind{small_transformer(GetParam().kind, GetParam().scenario, {GetParam().context}, 6)};
  const DataSet& data = recorded(GetParam().scenario);
};

/// All windows, and of those that begin with the episode all beginnings: these are what is seen before the window is
/// full.
TEST_P(TransformerThinkerTest, SaysWhatTrainingSaysOfTheWindowsItDraws) {
  const std::array thoughts{think(mind, data, 0), think(mind, data, 1)};
  const std::size_t length = std::min(GetParam().context, data.episode_steps());
  std::set<std::pair<std::size_t, std::size_t>> drawn;
  for (std::uint64_t step = 0; drawn.size() < 2 * (data.episode_steps() - length + 1); ++step) {
    ASSERT_LT(step, 1000U);
    const auto batch = draw_windows(data, mind.policy.scale, mind.policy.return_scale, 1, GetParam().context, 5, step);
    ASSERT_EQ(batch.window_rounds, std::vector<std::size_t>{length});
    const auto first = static_cast<std::size_t>(batch.timesteps.front());
    const std::array prey{batch.opponent.numbers[0], batch.opponent.numbers[1]};
    const std::size_t episode = prey == prey_action(data, 0, first) ? 0 : 1;
    if (!drawn.insert({episode, first}).second) continue;
    for (std::size_t rounds = first == 0 ? 1 : length; rounds <= length; ++rounds)
      expect_thoughts(mind, batch, first, rounds, thoughts[episode]);
  }
}

/// As long as the window has not moved, nothing needs to be put in by hand: all that the training pass says of an
/// episode's beginning is what was thought.
TEST_P(TransformerThinkerTest, SaysWhatTheLossOfItsOwnModeSaysWhileTheWindowStays) {
  const auto thoughts = think(mind, data, 1);
  sct::Batch<float> batch;
  for (std::uint64_t step = 0; batch.timesteps.empty() || batch.timesteps.front() != 0 ||
                               batch.opponent.numbers[0] != prey_action(data, 1, 0)[0];
       ++step)
    batch = draw_windows(data, mind.policy.scale, mind.policy.return_scale, 1, GetParam().context, 5, step);
  const bool fed = mind.policy.mode == sct::LossMode::selfconf || mind.policy.mode == sct::LossMode::composite;
  const auto said = training_pass(mind, mind.policy.mode, batch, batch.rounds());
  for (std::size_t t = 0; t < batch.rounds(); ++t) {
    const auto& acted = fed ? thoughts.actions[t] : thoughts.actions_on_truth[t];
    EXPECT_LT((said.action.row(index(t)) - acted).cwiseAbs().maxCoeff(), tolerance) << t;
    if (!mind.believes()) continue;
    EXPECT_LT((said.belief.row(index(t)) - thoughts.beliefs[t]).cwiseAbs().maxCoeff(), tolerance) << t;
  }
}

TEST_P(TransformerThinkerTest, MayBeAskedAgainWithOtherBeliefs) {
  TransformerThinker asked_once(mind, 1, 3), asked_often(mind, 1, 3), misled(mind, 1, 3);
  const Matrix<float> other = one_row({0.9F, -0.7F});
  float moved = 0;
  float led_astray = 0;
  for (std::size_t t = 0; t < data.episode_steps(); ++t) {
    const Sight sight(data, 0, t);
    const std::array glimpses{sight.glimpse()};
    const Matrix<float> belief = asked_once.see(glimpses);
    EXPECT_EQ(asked_often.see(glimpses), belief);
    EXPECT_EQ(misled.see(glimpses), belief);  // beliefs do not come from what was believed
    const Matrix<float> action = asked_once.act(belief);
    EXPECT_EQ(asked_often.act(belief), action);
    const Matrix<float> moved_action = asked_often.act(other);
    EXPECT_EQ(asked_often.act(belief), action);
    moved += (moved_action - action).cwiseAbs().sum();
    led_astray += (Matrix<float>(misled.act(belief)) - action).cwiseAbs().sum();
    misled.act(other);  // the last ones are remembered
  }
  const bool remembers = mind.policy.mode == sct::LossMode::selfconf || mind.policy.mode == sct::LossMode::composite;
  EXPECT_EQ(moved > 0.05F, mind.acts_on_belief()) << moved;
  EXPECT_EQ(led_astray > 0, remembers && GetParam().context > 1) << led_astray;
}

TEST_P(TransformerThinkerTest, ThinksOfAnEpisodeToTheBitTheSameWhateverIsBesideIt) {
  constexpr std::size_t episodes = 7;
  TransformerThinker together(mind, episodes, 3);
  std::vector<TransformerThinker> alone;
  for (std::size_t e = 0; e < episodes; ++e) alone.emplace_back(mind, 1, 3);
  for (std::size_t t = 0; t < data.episode_steps(); ++t) {
    std::vector<Sight> sights;
    for (std::size_t e = 0; e < episodes; ++e) {
      sights.emplace_back(data, e % 2, t);
      for (float& number : sights.back().observations) number += 0.1F * static_cast<float>(e);
    }
    std::vector<Glimpse> glimpses;
    for (const auto& sight : sights) glimpses.push_back(sight.glimpse());
    const Matrix<float> beliefs = together.see(glimpses);
    const Matrix<float> actions = together.act(beliefs);
    ASSERT_EQ(beliefs.rows(), index(episodes));
    ASSERT_EQ(actions.rows(), index(episodes));
    ASSERT_EQ(actions.cols(), 6);
    for (std::size_t e = 0; e < episodes; ++e) {
      const Matrix<float> belief = alone[e].see(std::span(glimpses).subspan(e, 1));
      ASSERT_EQ(belief, Matrix<float>(beliefs.row(index(e)))) << "episode " << e << ", step " << t;
      ASSERT_EQ(alone[e].act(belief), Matrix<float>(actions.row(index(e)))) << "episode " << e << ", step " << t;
    }
  }
}

TEST_P(TransformerThinkerTest, BeginsAnew) {
  TransformerThinker fresh(mind, 1, 3), used(mind, 1, 3);
  for (const std::size_t steps : {1, 9, 25}) {
    for (std::size_t t = 0; t < steps; ++t) {
      const Sight sight(data, 1, t);
      const std::array glimpses{sight.glimpse()};
      used.act(used.see(glimpses));
    }
    used.restart();
    fresh.restart();
    for (std::size_t t = 0; t < 6; ++t) {
      const Sight sight(data, 0, t);
      const std::array glimpses{sight.glimpse()};
      const Matrix<float> belief = fresh.see(glimpses);
      EXPECT_EQ(used.see(glimpses), belief);
      EXPECT_EQ(used.act(belief), fresh.act(belief));
    }
    used.restart();
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, TransformerThinkerTest, ::testing::ValuesIn(specimens()), [](const auto& specimen) {
  return std::string(specimen.param.kind.name) + "_" + std::to_string(specimen.param.context) + "_" +
         specimen.param.scenario;
});

/// The return that is asked for is embedded scaled, and what was earned is taken off it.
TEST(TransformerThinkerTarget, IsInUnitsOfReward) {
  auto policy = small_transformer();
  const TransformerMind mind(policy);
  policy.return_scale = 1;
  const TransformerMind unscaled(policy);
  const auto& data = recorded("simple_tag");
  TransformerThinker one(mind, 1, 40), other(unscaled, 1, 4), third(mind, 1, 41);
  float moved = 0;
  for (std::size_t t = 0; t < 10; ++t) {
    Sight sight(data, 0, t);
    const std::array glimpses{sight.glimpse()};
    auto glimpse = sight.glimpse();
    glimpse.reward /= 10;
    const std::array tenth{glimpse};
    const Matrix<float> belief = one.see(glimpses);
    EXPECT_LT((other.see(tenth) - belief).cwiseAbs().maxCoeff(), tolerance);
    moved += (third.see(glimpses) - belief).cwiseAbs().sum();
    one.act(belief), other.act(belief), third.act(belief);
  }
  EXPECT_GT(moved, 1e-3F);
}

TEST(TransformerMind, KnowsWhatItLooksAt) {
  for (const auto& kind : testing::transformer_kinds) {
    const TransformerMind mind(small_transformer(kind));
    EXPECT_EQ(mind.believes(), kind.mode != sct::LossMode::action_only) << kind.name;
    EXPECT_EQ(mind.acts_on_belief(), kind.readout != sct::Readout::own) << kind.name;
  }
}

}  // namespace
}  // namespace folk::mpe
