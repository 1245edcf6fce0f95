#include <folk/games/error.h>
#include <folk/mpe/evaluation/episodes.h>
#include <folk/mpe/online/training.h>
#include <folk/mpe/world/batch.h>
#include <folk/mpe/world/random_stream.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace folk::mpe {
namespace {

double half_cosine(double from, double to, double done) {
  return to + (from - to) * 0.5 * (1 + std::cos(std::numbers::pi * std::clamp(done, 0.0, 1.0)));
}

/// An action rounded to what the memory holds: a round can be made again from its actions.
double as_remembered(double action) { return static_cast<double>(static_cast<float>(action)); }

}  // namespace

/// The block in which rounds are played.
struct OnlineTraining::Rollout {
  Batch batch;
  std::unique_ptr<Player> prey;
  std::vector<Actor<float>> actors;
};

OnlineTraining::OnlineTraining(const Scenario& scenario, const OnlineSettings& settings, Controller prey)
    : layout_(scenario),
      settings_(settings),
      prey_(std::move(prey)),
      learner_(layout_, settings),
      memory_(layout_, settings.memory),
      rollout_(new Rollout{Batch(scenario, round_episodes), nullptr, {}}) {
  if (prey_.one_by_one)
    throw UsageError(prey_.name + ": a program on a pipe cannot be trained against; it is too slow");
  if (!settings.prey_learns) rollout_->prey = prey_.player(layout_, scenario.prey());
}

OnlineTraining::~OnlineTraining() = default;

double OnlineTraining::share_done() const {
  return static_cast<double>(episodes()) / static_cast<double>(settings_.episodes);
}

void OnlineTraining::play_round(std::uint64_t round) {
  auto& [batch, prey, actors] = *rollout_;
  actors.clear();
  for (std::size_t agent = 0; agent < learner_.agents(); ++agent) actors.emplace_back(learner_.policy(agent));
  const double noise =
      settings_.final_exploration + (settings_.exploration - settings_.final_exploration) * (1 - share_done());
  batch.reset(settings_.seed, round * round_episodes);
  const Block block = batch.block(0);
  memory_.begin_round();
  Moment moment{settings_.seed, round * round_episodes, 0};
  const std::size_t steps = layout_.scenario().episode_steps;
  if (prey) prey->start(layout_, block, layout_.scenario().prey(), moment);
  for (; moment.step <= steps; ++moment.step) {
    memory_.observe(layout_, block, moment.step);
    if (prey) {
      prey->act(layout_, block, layout_.scenario().prey(), moment);
      const auto [x, y] = action_rows(block, layout_.scenario().prey());
      for (double* row : {x, y})
        for (std::size_t lane = 0; lane < round_episodes; ++lane) row[lane] = as_remembered(row[lane]);
    }
    for (std::size_t agent = 0; agent < actors.size() && moment.step < steps; ++agent) {
      auto& observations = actors[agent].observations(round_episodes);
      const double* row = block.observations + layout_.observation_begin(agent) * block_lanes;
      for (Index k = 0; k < observations.cols(); ++k, row += block_lanes)
        for (std::size_t lane = 0; lane < round_episodes; ++lane)
          observations(index(lane), k) = static_cast<float>(row[lane]);
      const auto& actions = actors[agent].act();
      const auto [x, y] = action_rows(block, agent);
      for (std::size_t lane = 0; lane < round_episodes; ++lane) {
        RandomStream random =
            random_stream(settings_.seed, RandomUse::exploration, moment.first + lane, moment.step, agent);
        const auto chosen = [&](Index axis) {
          const double action = static_cast<double>(actions(index(lane), axis)) + noise * random.normal();
          return as_remembered(std::clamp(action, -1.0, 1.0));
        };
        x[lane] = chosen(0);
        y[lane] = chosen(1);
      }
    }
    if (const auto bad = find_bad_action(layout_, block))
      throw UsageError("training has diverged, an action is no number any more: lower learning-rate or clip");
    memory_.act(layout_, block, moment.step);
    if (moment.step == steps) break;
    step(layout_, block);
    memory_.reward(layout_, block, moment.step);
  }
}

/// Fills the memory with a round that was played before, from what was done in it.
void OnlineTraining::repeat_round(std::uint64_t round, const std::vector<float>& actions) {
  Batch& batch = rollout_->batch;
  batch.reset(settings_.seed, round * round_episodes);
  const Block block = batch.block(0);
  memory_.begin_round();
  const std::size_t steps = layout_.scenario().episode_steps;
  const std::size_t rows = layout_.action_rows();
  for (std::size_t step = 0; step <= steps; ++step) {
    memory_.observe(layout_, block, step);
    for (std::size_t lane = 0; lane < round_episodes; ++lane)
      for (std::size_t k = 0; k < rows; ++k)
        block.actions[k * block_lanes + lane] = static_cast<double>(actions[(lane * (steps + 1) + step) * rows + k]);
    memory_.act(layout_, block, step);
    if (step == steps) break;
    mpe::step(layout_, block);
    memory_.reward(layout_, block, step);
  }
}

OnlineState OnlineTraining::state() const {
  OnlineState state{rounds_,  updates(), learner_.state(), critic_losses_, values_, loss_updates_, value_updates_,
                    history_, {}};
  for (std::uint64_t round = rounds_ - memory_.rounds_held(); round < rounds_; ++round)
    state.actions.push_back(memory_.round_actions(round));
  return state;
}

void OnlineTraining::restore(OnlineState state) {
  const std::uint64_t last = (settings_.episodes + round_episodes - 1) / round_episodes;
  if (state.rounds > last)
    throw UsageError(
        fmt::format("the checkpoint is at episode {}, beyond the last, {}: give more episodes or start anew",
                    state.rounds * round_episodes, settings_.episodes));
  const std::size_t numbers = round_episodes * (layout_.scenario().episode_steps + 1) * layout_.action_rows();
  bool fits = state.actions.size() == std::min<std::uint64_t>(state.rounds, memory_.capacity());
  for (const auto& actions : state.actions) fits = fits && actions.size() == numbers;
  for (const auto& evaluation : state.history) {
    fits = fits && evaluation.actors.size() == learner_.agents();
    for (std::size_t k = 0; fits && k < evaluation.actors.size(); ++k)
      fits = evaluation.actors[k].size() == learner_.actor_shape(k).parameters();
  }
  if (!fits) throw UsageError("a checkpoint of another run: give that run's settings or start anew");
  learner_.restore(std::move(state.agents), state.updates);
  rounds_ = state.rounds;
  critic_losses_ = state.critic_losses;
  values_ = state.values;
  loss_updates_ = state.loss_updates;
  value_updates_ = state.value_updates;
  history_ = std::move(state.history);
  memory_.begin_at(rounds_ - state.actions.size());
  for (std::size_t i = 0; i < state.actions.size(); ++i)
    repeat_round(rounds_ - state.actions.size() + i, state.actions[i]);
}

void OnlineTraining::learn() {
  const std::size_t played = static_cast<std::size_t>(rounds_) * round_episodes * layout_.scenario().episode_steps;
  if (played < settings_.first_update || memory_.transitions() < settings_.batch) return;
  const double rate = half_cosine(settings_.learning_rate, settings_.final_learning_rate, share_done());
  const std::size_t before = played - round_episodes * layout_.scenario().episode_steps;
  for (std::size_t n = before / settings_.update_every; n < played / settings_.update_every; ++n) {
    const auto losses = learner_.update(memory_, rate);
    if (!std::isfinite(losses.critic) || !std::isfinite(losses.value.value_or(0)))
      throw UsageError("training has diverged, its losses are no numbers any more: lower learning-rate or clip");
    critic_losses_ += losses.critic;
    ++loss_updates_;
    if (!losses.value) continue;
    values_ += *losses.value;
    ++value_updates_;
  }
}

void OnlineTraining::round() {
  play_round(rounds_);
  ++rounds_;
  learn();
}

bool OnlineTraining::evaluation_due() const {
  const std::uint64_t last = history_.empty() ? 0 : history_.back().episodes;
  if (history_.empty() || (finished() && last < episodes())) return true;
  return episodes() / settings_.evaluate_every > last / settings_.evaluate_every;
}

Cast OnlineTraining::cast_of(const std::vector<std::vector<float>>& actors) const {
  OnlineEvaluation standing;
  standing.actors = actors;
  Cast cast{policy_controller("predators", policy(standing, Side::predators), Side::predators, scenario()), prey_};
  if (settings_.prey_learns)
    cast.prey = policy_controller("prey", policy(standing, Side::prey), Side::prey, scenario());
  return cast;
}

void OnlineTraining::evaluate(const Progress& progress) {
  OnlineEvaluation evaluation;
  evaluation.episodes = episodes();
  evaluation.updates = updates();
  const auto mean = [](double sum, std::uint64_t count) {
    return sum / static_cast<double>(std::max<std::uint64_t>(1, count));
  };
  evaluation.critic_loss = mean(critic_losses_, loss_updates_);
  evaluation.value = mean(values_, value_updates_);
  for (const auto& agent : learner_.state()) evaluation.actors.push_back(agent.actor.parameters);
  const auto scores =
      score_episodes(layout_, cast_of(evaluation.actors),
                     {settings_.evaluation_seed, 0, settings_.evaluation_episodes, settings_.threads}, progress);
  const double count = static_cast<double>(scores.size());
  for (const auto& score : scores) {
    evaluation.predators += score.predators / count;
    evaluation.prey += score.prey / count;
  }
  double squares = 0;
  for (const auto& score : scores) squares += std::pow(score.predators - evaluation.predators, 2);
  evaluation.error = count > 1 ? std::sqrt(squares / (count - 1) / count) : 0;
  history_.push_back(std::move(evaluation));
  critic_losses_ = values_ = 0;
  loss_updates_ = value_updates_ = 0;
}

Policy OnlineTraining::policy(const OnlineEvaluation& evaluation, Side side) const {
  Policy policy{scenario().name, side, {}, {}};
  for (std::size_t agent = 0; agent < evaluation.actors.size(); ++agent) {
    if (side_of(layout_, agent) != side) continue;
    policy.networks.push_back({learner_.actor_shape(agent), evaluation.actors[agent], std::nullopt, Squash::tanh});
  }
  if (policy.networks.empty()) throw UsageError("the prey does not learn in this run: it has no policy of its own");
  return policy;
}

}  // namespace folk::mpe
