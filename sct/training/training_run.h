#pragma once
// A whole training run: steps, evaluations, and the policy that is kept.

#include <folk/analysis/play/sampled_play.h>
#include <folk/games/progress.h>
#include <folk/sct/data/exploration.h>
#include <folk/sct/policy/policy.h>
#include <folk/sct/training/aggregation.h>
#include <folk/sct/training/checkpoint.h>
#include <folk/sct/training/selection.h>
#include <folk/sct/training/trainer.h>
#include <folk/strategies/strategy.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace folk::sct {

/// What a run does beside training.
struct RunSettings {
  std::uint64_t steps = 10'000;
  std::uint64_t evaluate_every = 250;       ///< steps; the end is evaluated in any case
  std::vector<double> targets;              ///< the grid, unscaled, at least one
  Sampling validation;                      ///< how the policy plays when it is evaluated
  std::vector<Strategy> held_out{};         ///< whom it plays there beside its roster; empty: nobody
  std::uint64_t patience = 0;               ///< evaluations without a higher figure that end the run; 0: none do
  std::uint64_t aggregate_every = 0;        ///< steps between additions to the data by a teacher; 0: none
  std::uint64_t aggregate_repetitions = 4;  ///< matches against each opponent whose own moves slip, beside one without
  double aggregate_slip = 0.05;             ///< their probability
  std::uint64_t explore_every = 50;         ///< steps after which half of what was explored gives way to new matches
  std::uint64_t explore_matches = 400;      ///< that many
  std::string description;                  ///< all that the run depends on: Checkpoint::run
};

/// Does one thing at a time, so that its caller can stop between any two, save the run and go on with it elsewhere.
class TrainingRun {
public:
  /// `roster`: whom the policy plays in its evaluations. `record`: what the policy file says beside what is measured.
  /// `teacher`: labels what the policy meets in training, every aggregate_every steps; null where that is 0.
  /// `exploration`: what is learnt from, instead of `lessons`, which are none then.
  TrainingRun(RunSettings settings, const TrainingSettings& training, std::vector<Lesson> lessons,
              std::vector<Strategy> roster, TrainingRecord record,
              std::shared_ptr<const BayesTeacher> teacher = nullptr,
              std::shared_ptr<const Exploration> exploration = nullptr);

  std::uint64_t steps() const { return trainer_.steps(); }
  bool finished() const { return steps() >= settings_.steps || out_of_patience_; }

  /// True when the run ended for want of patience, before its last step.
  bool stopped_early() const { return out_of_patience_ && steps() < settings_.steps; }

  /// One step of training. Throws UsageError when the losses are no numbers any more.
  void step();

  /// True at each multiple of evaluate_every and at the end, until evaluate() is done.
  bool evaluation_due() const;

  /// True when a longer run would not evaluate here: an evaluation that should not be in a checkpoint.
  bool only_due_at_the_end() const { return steps() % settings_.evaluate_every != 0; }

  /// Plays the validation matches and applies the rule of selection.h. Throws Cancelled; whatever it throws, nothing
  /// has happened then: the evaluation is still due, here or after a checkpoint.
  void evaluate(const Progress& progress = nullptr);

  /// Losses since the last evaluation.
  const LossSums& losses() const { return losses_; }

  const std::vector<Evaluation>& history() const { return history_; }

  /// Index in the history of the evaluation whose policy is kept.
  std::size_t kept() const { return kept_; }

  /// How many matches the teacher has labelled in training.
  std::size_t added() const { return added_.size(); }

  /// How many explored matches have been learnt from so far.
  std::uint64_t explored() const {
    return exploration_ ? (steps() / settings_.explore_every + 2) * settings_.explore_matches : 0;
  }

  /// The kept policy, with its target; there must be a history.
  Policy policy() const;

  Checkpoint checkpoint() const;

  /// Goes on from a checkpoint of this run. Throws UsageError when it is of another run, or of a later step than this
  /// run's last, be it for want of patience.
  void restore(Checkpoint checkpoint);

private:
  Policy policy_with(std::vector<float> parameters) const;
  void aggregate();
  void explore(std::uint64_t portion);

  RunSettings settings_;
  TrainingSettings training_;
  std::vector<Strategy> roster_;
  TrainingRecord record_;
  std::shared_ptr<const BayesTeacher> teacher_;
  std::shared_ptr<const Exploration> exploration_;
  Trainer trainer_;
  LossSums losses_;
  std::vector<Lesson> added_;
  std::vector<Evaluation> history_;
  std::size_t kept_ = 0;
  bool out_of_patience_ = false;
  std::vector<float> kept_parameters_;
};

}  // namespace folk::sct
