#pragma once
// An offline training run: a learner's steps, the curve of its losses, and the run as bytes to go on with.

#include <folk/games/error.h>
#include <folk/mpe/offline/offline_learner.h>

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace folk::mpe {

/// A loss is no number any more.
class TrainingDiverged : public UsageError {
public:
  using UsageError::UsageError;
};

/// Mean losses since the point before.
struct LossPoint {
  std::uint64_t steps = 0;
  std::vector<double> losses;  ///< in the order of the learner's names
};

/// Does one step at a time, so that its caller can stop between any two, save the run and go on with it elsewhere.
class OfflineTraining {
public:
  /// `description`: all that the run depends on but the number of steps, one "key = value" a line.
  OfflineTraining(std::unique_ptr<OfflineLearner> learner, std::string description, std::uint64_t steps);

  const OfflineLearner& learner() const { return *learner_; }
  const std::string& description() const { return description_; }
  std::uint64_t steps() const { return learner_->steps(); }
  std::uint64_t last_step() const { return last_step_; }
  bool finished() const { return steps() >= last_step_; }

  /// Throws TrainingDiverged when a loss is no number any more.
  void step();

  /// What the losses are called; empty before the first step.
  const std::vector<std::string>& names() const { return names_; }

  /// A point every 1/100 of the run, rounded up to whole steps, and at the end.
  const std::vector<LossPoint>& curve() const { return curve_; }

  std::string checkpoint() const;

  /// Goes on from there; `source` (a path) is what messages call the bytes. Throws InputFileError "source: what; mend"
  /// when they are damaged and UsageError, naming what differs, when they are of another run or beyond the last step.
  void restore(std::string_view bytes, const std::string& source);

private:
  std::unique_ptr<OfflineLearner> learner_;
  std::string description_;
  std::uint64_t last_step_;
  std::vector<std::string> names_;
  std::vector<double> sums_;
  std::uint64_t summed_ = 0;
  std::vector<LossPoint> curve_;
};

}  // namespace folk::mpe
