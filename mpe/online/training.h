#pragma once
// An online training run: rounds of episodes, updates, and now and then an evaluation.

#include <folk/games/progress.h>
#include <folk/mpe/online/learner.h>
#include <folk/mpe/players/policy_file.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace folk::mpe {

/// How the agents that learn stood at some point, and their networks then.
struct OnlineEvaluation {
  std::uint64_t episodes = 0;  ///< played until then
  std::uint64_t updates = 0;
  double predators = 0;    ///< mean return of one predator over the evaluation's episodes
  double error = 0;        ///< its standard error
  double prey = 0;         ///< mean return of the prey
  double critic_loss = 0;  ///< mean since the evaluation before
  double value = 0;
  std::vector<std::vector<float>> actors;  ///< parameters of each agent that learns
};

/// All that changes in a run: saved and restored, it goes on as if it had never stopped.
struct OnlineState {
  std::uint64_t rounds = 0;
  std::uint64_t updates = 0;
  std::vector<LearningAgent> agents;
  double critic_losses = 0;  ///< sums since the last evaluation
  double values = 0;
  std::uint64_t loss_updates = 0;
  std::uint64_t value_updates = 0;
  std::vector<OnlineEvaluation> history;
  std::vector<std::vector<float>> actions;  ///< of the rounds that the memory holds, the oldest first
};

/// Does one thing at a time, so that its caller can stop between any two, save the run and go on with it elsewhere. All
/// that happens depends on the settings and the prey alone.
class OnlineTraining {
public:
  /// `prey`: who plays it while the predators learn; not asked for when the prey learns too.
  OnlineTraining(const Scenario& scenario, const OnlineSettings& settings, Controller prey);
  ~OnlineTraining();

  const OnlineSettings& settings() const { return settings_; }
  const Scenario& scenario() const { return layout_.scenario(); }
  std::uint64_t episodes() const { return rounds_ * round_episodes; }
  std::uint64_t updates() const { return learner_.updates(); }
  bool finished() const { return episodes() >= settings_.episodes; }

  /// Plays a round of episodes and learns from it. Throws UsageError when training has diverged.
  void round();

  /// True at multiples of evaluate_every and at the end, until evaluate() is done; before the first round too.
  bool evaluation_due() const;

  /// Throws Cancelled; whatever it throws, nothing has happened then: the evaluation is still due.
  void evaluate(const Progress& progress = nullptr);
  const std::vector<OnlineEvaluation>& history() const { return history_; }

  OnlineState state() const;

  /// Throws UsageError when the sizes are not this run's, or the state is of a later episode than its last.
  void restore(OnlineState state);

  /// Of an evaluation, the side's policy; the prey's only where it learned.
  Policy policy(const OnlineEvaluation& evaluation, Side side) const;

private:
  struct Rollout;

  double share_done() const;
  void play_round(std::uint64_t round);
  void repeat_round(std::uint64_t round, const std::vector<float>& actions);
  void learn();
  Cast cast_of(const std::vector<std::vector<float>>& actors) const;

  Layout layout_;
  OnlineSettings settings_;
  Controller prey_;
  Learner learner_;
  ReplayMemory memory_;
  std::unique_ptr<Rollout> rollout_;
  std::uint64_t rounds_ = 0;
  double critic_losses_ = 0;
  double values_ = 0;
  std::uint64_t loss_updates_ = 0;
  std::uint64_t value_updates_ = 0;
  std::vector<OnlineEvaluation> history_;
};

}  // namespace folk::mpe
