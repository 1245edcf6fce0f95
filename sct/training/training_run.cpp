#include <folk/games/error.h>
#include <folk/sct/data/recorded_play.h>
#include <folk/sct/policy/sct_player.h>
#include <folk/sct/training/training_run.h>
#include <folk/sct/training/validation.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace folk::sct {

TrainingRun::TrainingRun(RunSettings settings, const TrainingSettings& training, std::vector<Lesson> lessons,
                         std::vector<Strategy> roster, TrainingRecord record,
                         std::shared_ptr<const BayesTeacher> teacher, std::shared_ptr<const Exploration> exploration)
    : settings_(std::move(settings)),
      training_(training),
      roster_(std::move(roster)),
      record_(std::move(record)),
      teacher_(std::move(teacher)),
      exploration_(std::move(exploration)),
      trainer_(training, std::move(lessons)) {
  if (settings_.targets.empty()) throw UsageError("there is no target to ask a policy for: give one at least");
  if (settings_.evaluate_every == 0) throw UsageError("evaluations every 0 steps: give 1 at least");
  if (!exploration_) return;
  if (settings_.explore_every == 0 || settings_.explore_matches == 0)
    throw UsageError("exploring needs a number of steps and of matches: give 1 at least");
  trainer_.lessons().resize(2 * settings_.explore_matches);
  explore(0);
  explore(1);
}

/// Portion n of what is explored stands in the half n % 2 of the lessons; after step s the portions s / explore_every
/// and the next are there.
void TrainingRun::explore(std::uint64_t portion) {
  const std::uint64_t size = settings_.explore_matches;
  auto lessons = exploration_->matches(training_.seed, portion * size, size, training_.threads);
  std::move(lessons.begin(), lessons.end(),
            trainer_.lessons().begin() + static_cast<std::ptrdiff_t>(portion % 2 * size));
}

void TrainingRun::step() {
  const auto losses = trainer_.step();
  if (!std::isfinite(losses.total()))
    throw UsageError(
        fmt::format("training has diverged: the loss of step {} is {}; lower learning-rate or clip, or lengthen warmup",
                    steps(), losses.total()));
  losses_.add(losses);
  if (exploration_ && steps() % settings_.explore_every == 0) explore(steps() / settings_.explore_every + 1);
  if (teacher_ && settings_.aggregate_every > 0 && steps() % settings_.aggregate_every == 0) aggregate();
}

/// The policy as it is now plays; the teacher says what it should have done there (Ross, Gordon & Bagnell 2011).
void TrainingRun::aggregate() {
  auto now = policy_with(trainer_.parameters());
  now.training.return_target = teacher_->target();
  const auto player = transformer("learner", std::make_shared<const Mind>(std::move(now)));
  const auto& game = settings_.validation;
  const auto learn = [&](Noise slip, Repetitions repetitions) {
    const auto seed = training_.seed + (steps() << 20U);
    for (const auto& match : play_and_record(player, roster_, game.payoffs, game.criterion.rounds(), slip, repetitions,
                                             seed, training_.threads)) {
      added_.push_back(teacher_->label(match));
      trainer_.lessons().push_back(added_.back());
    }
  };
  learn(0, 1);
  if (settings_.aggregate_repetitions > 0) learn(settings_.aggregate_slip, settings_.aggregate_repetitions);
}

bool TrainingRun::evaluation_due() const {
  if (steps() == 0 || (!history_.empty() && history_.back().steps == steps())) return false;
  return finished() || steps() % settings_.evaluate_every == 0;
}

void TrainingRun::evaluate(const Progress& progress) {
  const auto& parameters = trainer_.parameters();
  auto scores =
      validate(policy_with(parameters), settings_.targets, roster_, settings_.held_out, settings_.validation, progress);
  history_.push_back({steps(), losses_.mean_belief(), losses_.mean_action(), std::move(scores)});
  losses_ = {};
  if (kept_parameters_.empty() || takes_over(history_.back(), history_[kept_])) {
    kept_ = history_.size() - 1;
    kept_parameters_ = parameters;
  }
  out_of_patience_ = end_of_patience(history_, settings_.patience).has_value();
}

Policy TrainingRun::policy_with(std::vector<float> parameters) const {
  Policy policy;
  policy.architecture = training_.architecture;
  policy.parameters = std::move(parameters);
  policy.training = record_;
  return policy;
}

Policy TrainingRun::policy() const {
  auto policy = policy_with(kept_parameters_);
  const auto& evaluation = history_.at(kept_);
  policy.training.return_target = best_target(evaluation).target;
  policy.training.steps = evaluation.steps;
  policy.training.final_belief_loss = evaluation.belief_loss;
  policy.training.final_action_loss = evaluation.action_loss;
  return policy;
}

Checkpoint TrainingRun::checkpoint() const {
  return {settings_.description, trainer_.state(), losses_, added_, history_, kept_, kept_parameters_};
}

void TrainingRun::restore(Checkpoint checkpoint) {
  if (const auto difference = difference_of_runs(checkpoint.run, settings_.description); !difference.empty())
    throw UsageError(
        fmt::format("the checkpoint is of another run: {}; give that run's settings or start anew", difference));
  if (checkpoint.training.optimiser.steps > settings_.steps)
    throw UsageError(fmt::format("the checkpoint is at step {}, beyond the last, {}: give more steps or start anew",
                                 checkpoint.training.optimiser.steps, settings_.steps));
  const auto end = end_of_patience(checkpoint.history, settings_.patience);
  if (end && checkpoint.history[*end].steps < checkpoint.training.optimiser.steps)
    throw UsageError(fmt::format(
        "the checkpoint is at step {}, and with a patience of {} this run ends at step {}: give more or start anew",
        checkpoint.training.optimiser.steps, settings_.patience, checkpoint.history[*end].steps));
  trainer_.restore(std::move(checkpoint.training));
  out_of_patience_ = end.has_value();
  if (exploration_) {
    explore(steps() / settings_.explore_every);
    explore(steps() / settings_.explore_every + 1);
  }
  losses_ = checkpoint.losses;
  added_ = std::move(checkpoint.added);
  trainer_.lessons().insert(trainer_.lessons().end(), added_.begin(), added_.end());
  history_ = std::move(checkpoint.history);
  kept_ = checkpoint.kept;
  kept_parameters_ = std::move(checkpoint.kept_parameters);
}

}  // namespace folk::sct
