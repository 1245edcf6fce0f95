#include <folk/mpe/online/learner.h>
#include <folk/mpe/world/batch.h>
#include <folk/mpe/world/random_stream.h>

#include <gtest/gtest.h>

#include <cmath>

#include "small_training.h"

namespace folk::mpe {
namespace {

/// The mean over the whole memory of what an update's gradients are gradients of, in double, written down plainly.
struct Plain {
  const Layout& layout;
  const OnlineSettings& settings;
  const Learner& learner;

  static std::vector<double> as_double(const std::vector<float>& numbers) { return {numbers.begin(), numbers.end()}; }

  static double value(const MlpShape& shape, const std::vector<float>& parameters, const std::vector<double>& input,
                      std::size_t output = 0) {
    std::vector<double> x = input;
    for (std::size_t layer = 0; layer < shape.layers(); ++layer) {
      std::vector<double> y(shape.widths()[layer + 1]);
      for (std::size_t i = 0; i < y.size(); ++i) {
        y[i] = static_cast<double>(parameters[shape.bias(layer) + i]);
        for (std::size_t k = 0; k < x.size(); ++k)
          y[i] += static_cast<double>(parameters[shape.weight(layer) + i * x.size() + k]) * x[k];
        if (layer + 1 < shape.layers()) y[i] = std::max(0.0, y[i]);
      }
      x = std::move(y);
    }
    return x[output];
  }

  std::vector<double> observation(const float* row, std::size_t agent) const {
    return {row + layout.observation_begin(agent), row + layout.observation_begin(agent + 1)};
  }

  /// What a critic sees: a row, with the actions of some agents put in.
  std::vector<double> critic_input(const float* row, std::size_t agent,
                                   const std::vector<std::vector<double>>& actions) const {
    const std::size_t all = layout.observation_rows();
    if (settings.critic == Critic::independent) {
      auto input = observation(row, agent);
      for (std::size_t axis = 0; axis < 2; ++axis)
        input.push_back(actions[agent].empty() ? static_cast<double>(row[all + 2 * agent + axis])
                                               : actions[agent][axis]);
      return input;
    }
    std::vector<double> input(row, row + all + layout.action_rows());
    for (std::size_t k = 0; k < actions.size(); ++k)
      for (std::size_t axis = 0; axis < actions[k].size(); ++axis) input[all + 2 * k + axis] = actions[k][axis];
    return input;
  }

  std::vector<double> action(std::size_t agent, const std::vector<float>& parameters, const float* row) const {
    std::vector<double> chosen;
    for (std::size_t axis = 0; axis < 2; ++axis)
      chosen.push_back(std::tanh(value(learner.actor_shape(agent), parameters, observation(row, agent), axis)));
    return chosen;
  }

  /// (Q - r - discount min Q')^2 of one transition.
  double critic_error(const ReplayMemory::Transition& transition, std::size_t agent, std::size_t which) const {
    const auto& state = learner.state();
    std::vector<std::vector<double>> next(layout.agents());
    for (std::size_t k = 0; k < learner.agents(); ++k) next[k] = action(k, state[k].actor.target, transition.next);
    const auto input = critic_input(transition.next, agent, next);
    double target = INFINITY;
    for (const auto& critic : state[agent].critics)
      target = std::min(target, value(learner.critic_shape(agent), critic.target, input));
    const std::size_t reward =
        layout.observation_rows() + layout.action_rows() + (agent + 1 == layout.agents() ? 1 : 0);
    const double now = value(learner.critic_shape(agent), state[agent].critics[which].parameters,
                             critic_input(transition.now, agent, std::vector<std::vector<double>>(layout.agents())));
    return now - static_cast<double>(transition.now[reward]) - settings.discount * target;
  }
};

double mean_square_error(const Layout& layout, const OnlineSettings& settings, const Learner& learner,
                         const ReplayMemory& memory) {
  const Plain plain{layout, settings, learner};
  double sum = 0;
  double count = 0;
  for (std::size_t p = 0; p < 4; ++p) {  // the batch as the learner draws it: four pieces, each with a stream
    RandomStream random = random_stream(settings.seed, RandomUse::replay, learner.updates(), p);
    for (std::size_t r = 0; r < settings.batch / 4; ++r) {
      const auto transition = memory.transition(static_cast<std::size_t>(random() % memory.transitions()));
      for (std::size_t agent = 0; agent < learner.agents(); ++agent)
        for (std::size_t which = 0; which < settings.critics(); ++which, ++count)
          sum += std::pow(plain.critic_error(transition, agent, which), 2);
    }
  }
  return sum / count;
}

TEST(Learner, ItsCriticLossIsTheOneWrittenDownPlainly) {
  for (const auto algorithm : {Algorithm::matd3, Algorithm::maddpg})
    for (const auto critic : {Critic::centralised, Critic::independent})
      for (const bool prey : {false, true}) {
        OnlineSettings settings = test::small_settings();
        settings.algorithm = algorithm;
        settings.critic = critic;
        settings.prey_learns = prey;
        settings.batch = 32;
        const Layout layout(Scenario::named("simple_world"));
        const auto memory = test::random_memory(layout, 2);
        Learner learner(layout, settings);
        for (int i = 0; i < 5; ++i) {  // targets and networks differ after some updates
          const double plain = mean_square_error(layout, settings, learner, memory);
          const auto losses = learner.update(memory, 1e-2);
          EXPECT_NEAR(losses.critic, plain, 1e-4 * (1 + plain))
              << to_string(algorithm) << " " << to_string(critic) << " " << prey << " update " << i;
        }
      }
}

/// The step of plain gradient descent is hidden by Adam: the direction is tested through what it does.
TEST(Learner, CriticsFitAndActorsClimb) {
  OnlineSettings settings = test::small_settings();
  settings.discount = 0;  // the critic's target is the reward alone
  settings.algorithm = Algorithm::maddpg;
  settings.batch = 256;
  const Layout layout(Scenario::named("simple_tag"));
  const auto memory = test::random_memory(layout, 4);
  Learner learner(layout, settings);
  const double first = learner.update(memory, 3e-3).critic;
  double last = 0;
  double value = 0;
  for (int i = 0; i < 400; ++i) {
    const auto losses = learner.update(memory, 3e-3);
    last = losses.critic;
    if (i == 200) value = *losses.value;
    if (i == 399) {
      EXPECT_GT(*losses.value, value);
    }
  }
  EXPECT_LT(last, 0.6 * first);
}

TEST(Learner, TheActorsGradientIsThatOfTheCriticAtItsOwnAction) {
  // With one update of a tiny rate, each parameter of an actor moves by the rate against the sign of its gradient
  // (Adam's first step), which central differences of the objective must share.
  OnlineSettings settings = test::small_settings();
  settings.algorithm = Algorithm::maddpg;
  settings.batch = 64;
  settings.hidden = 5;
  settings.action_penalty = 0.05;
  const Layout layout(Scenario::named("simple_tag"));
  const auto memory = test::random_memory(layout, 1);
  Learner learner(layout, settings);
  auto before = learner.state();
  learner.update(memory, 1e-9);  // the critics hardly move
  const Plain plain{layout, settings, learner};
  const std::size_t agent = 1;
  const auto objective = [&](const std::vector<float>& parameters) {
    double sum = 0;
    for (std::size_t p = 0; p < 4; ++p) {
      RandomStream random = random_stream(settings.seed, RandomUse::replay, 0, p);
      for (std::size_t r = 0; r < settings.batch / 4; ++r) {
        const auto transition = memory.transition(static_cast<std::size_t>(random() % memory.transitions()));
        std::vector<std::vector<double>> actions(layout.agents());
        actions[agent] = plain.action(agent, parameters, transition.now);
        sum -= Plain::value(learner.critic_shape(agent), before[agent].critics[0].parameters,
                            plain.critic_input(transition.now, agent, actions));
        for (std::size_t axis = 0; axis < 2; ++axis) {
          const double raw =
              Plain::value(learner.actor_shape(agent), parameters, plain.observation(transition.now, agent), axis);
          sum += settings.action_penalty * raw * raw / 2;
        }
      }
    }
    return sum / static_cast<double>(settings.batch);
  };
  std::size_t compared = 0;
  const auto& moved = learner.state()[agent].actor.optimiser.first;  // (1 - beta_1) times the clipped gradient
  for (std::size_t i = 0; i < moved.size(); i += 7) {
    auto parameters = before[agent].actor.parameters;
    constexpr float h = 1e-2F;
    parameters[i] += h;
    const double high = objective(parameters);
    parameters[i] -= 2 * h;
    const double slope = (high - objective(parameters)) / (2 * static_cast<double>(h));
    EXPECT_NEAR(static_cast<double>(moved[i]) / 0.1, slope, 2e-5 + 0.02 * std::abs(slope)) << i;
    compared += std::abs(slope) > 2e-4 ? 1 : 0;
  }
  EXPECT_GT(compared, 5U);
}

TEST(Learner, ActorsAndTargetsFollowEverySecondUpdateOfMatd3) {
  OnlineSettings settings = test::small_settings();
  settings.averaging = 0.25;
  const Layout layout(Scenario::named("simple_tag"));
  const auto memory = test::random_memory(layout, 1);
  Learner learner(layout, settings);
  const auto begin = learner.state();
  EXPECT_FALSE(learner.update(memory, 1e-2).value);
  const auto once = learner.state();
  EXPECT_TRUE(learner.update(memory, 1e-2).value);
  const auto twice = learner.state();
  for (std::size_t agent = 0; agent < 3; ++agent) {
    EXPECT_EQ(once[agent].actor.parameters, begin[agent].actor.parameters);
    EXPECT_NE(twice[agent].actor.parameters, begin[agent].actor.parameters);
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_NE(once[agent].critics[k].parameters, begin[agent].critics[k].parameters);
      EXPECT_EQ(once[agent].critics[k].target, begin[agent].critics[k].target);
      for (std::size_t i = 0; i < begin[agent].critics[k].target.size(); i += 11)
        EXPECT_NEAR(twice[agent].critics[k].target[i],
                    0.75F * begin[agent].critics[k].target[i] + 0.25F * twice[agent].critics[k].parameters[i], 1e-6F);
    }
  }
}

TEST(Learner, MaddpgMovesAllAtEachUpdate) {
  OnlineSettings settings = test::small_settings();
  settings.algorithm = Algorithm::maddpg;
  settings.prey_learns = true;
  const Layout layout(Scenario::named("simple_tag"));
  const auto memory = test::random_memory(layout, 1);
  Learner learner(layout, settings);
  const auto begin = learner.state();
  ASSERT_EQ(begin.size(), 4U);
  EXPECT_TRUE(learner.update(memory, 1e-2).value);
  for (std::size_t agent = 0; agent < 4; ++agent) {
    ASSERT_EQ(begin[agent].critics.size(), 1U);
    EXPECT_NE(learner.state()[agent].actor.parameters, begin[agent].actor.parameters);
    EXPECT_NE(learner.state()[agent].actor.target, begin[agent].actor.target);
    EXPECT_NE(learner.state()[agent].critics[0].target, begin[agent].critics[0].target);
  }
}

TEST(LearnerThreads, ChangeNoBit) {
  const Layout layout(Scenario::named("simple_tag"));
  const auto memory = test::random_memory(layout, 2);
  const auto after = [&](unsigned threads) {
    OnlineSettings settings = test::small_settings();
    settings.threads = threads;
    settings.target_noise = 0.2;
    Learner learner(layout, settings);
    for (int i = 0; i < 6; ++i) learner.update(memory, 1e-2);
    return learner.state()[2].critics[1].parameters;
  };
  EXPECT_EQ(after(1), after(2));
  EXPECT_EQ(after(1), after(5));
}

}  // namespace
}  // namespace folk::mpe
