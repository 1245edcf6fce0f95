#pragma once
// What a training run says on stderr while it lasts.

#include <folk/sct/training/training_run.h>

#include <chrono>
#include <cstdint>
#include <string>

namespace folk::tools {

/// On a terminal a line that is redrawn: the step, the losses, tokens a second, the time left. Everywhere a line for
/// each evaluation.
class TrainProgress {
public:
  /// `label` begins every line; `step_tokens`: tokens of one step.
  TrainProgress(bool enabled, std::string label, std::uint64_t first_step, std::uint64_t steps,
                std::uint64_t step_tokens);
  TrainProgress(const TrainProgress&) = delete;
  TrainProgress& operator=(const TrainProgress&) = delete;
  ~TrainProgress();

  void step(const sct::TrainingRun& run);
  void evaluation(const sct::TrainingRun& run);

private:
  using Clock = std::chrono::steady_clock;

  double elapsed() const;
  double tokens_per_second(std::uint64_t step) const;
  double seconds_left(std::uint64_t step) const;
  void erase();

  bool enabled_;
  bool redraws_;
  std::string label_;
  std::uint64_t first_step_;
  std::uint64_t steps_;
  std::uint64_t step_tokens_;
  Clock::time_point begin_ = Clock::now();
  Clock::time_point next_ = begin_ + std::chrono::seconds(1);
  double training_ = 0;  // seconds in steps, evaluations left out
  Clock::time_point resumed_ = begin_;
  bool drawn_ = false;
};

}  // namespace folk::tools
