#pragma once
// Training, step by step, from any point on.

#include <folk/sct/data/windows.h>
#include <folk/sct/training/adamw.h>
#include <folk/sct/training/batch_gradient.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace folk::sct {

/// Everything that a training run depends on, besides its data; `threads` changes no bit of it.
struct TrainingSettings {
  Architecture architecture;
  LossMode mode = LossMode::teacher;
  AdamWSettings optimiser;
  WindowSettings windows;
  double dropout = 0.1;
  double averaging =
      0;  ///< decay of the parameters' moving average (Polyak & Juditsky 1992); 0: the parameters themselves
  std::uint64_t seed = 1;
  unsigned threads = 1;
};

/// What changes from step to step; saved and restored, training goes on as if it had never stopped.
struct TrainingState {
  std::vector<float> parameters;
  std::vector<float> average;  ///< empty without averaging
  AdamWState<float> optimiser;
};

/// A training run. Step n draws its windows and its dropout from the seed and n alone.
class Trainer {
public:
  Trainer(const TrainingSettings& settings, std::vector<Lesson> lessons);

  /// Takes one optimiser step; returns the batch's losses before it.
  Losses step();

  std::uint64_t steps() const { return state_.optimiser.steps; }

  /// What a policy should be made of: the average where there is one.
  const std::vector<float>& parameters() const { return state_.average.empty() ? state_.parameters : state_.average; }

  const TrainingState& state() const { return state_; }

  /// Throws UsageError when the sizes are not this network's.
  void restore(TrainingState state);

  /// More to learn from; windows are drawn from all lessons alike.
  std::vector<Lesson>& lessons() { return lessons_; }

private:
  TrainingSettings settings_;
  std::vector<Lesson> lessons_;
  std::unique_ptr<Network<float>> network_;
  BatchGradient<float> batch_gradient_;
  TrainingState state_;
  std::vector<float> gradient_;
};

}  // namespace folk::sct
