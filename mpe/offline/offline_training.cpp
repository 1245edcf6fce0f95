#include <folk/games/error.h>
#include <folk/mpe/offline/offline_training.h>
#include <folk/sct/files/record_bytes.h>
#include <folk/sct/training/checkpoint.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace folk::mpe {
namespace {

constexpr sct::RecordKind kind{"FOLKOFFL", 1, "mpe-train offline"};
constexpr std::uint64_t curve_points = 100;

}  // namespace

OfflineTraining::OfflineTraining(std::unique_ptr<OfflineLearner> learner, std::string description, std::uint64_t steps)
    : learner_(std::move(learner)),
      description_(std::move(description)),
      last_step_(steps) {}

void OfflineTraining::step() {
  const auto losses = learner_->step();
  if (names_.empty()) {
    for (const auto& loss : losses) names_.emplace_back(loss.name);
    sums_.assign(losses.size(), 0.0);
  }
  if (losses.size() != names_.size())
    throw UsageError(fmt::format("the checkpoint is of another run: {} losses there, {} here; start anew",
                                 names_.size(), losses.size()));
  for (std::size_t i = 0; i < losses.size(); ++i) {
    if (!std::isfinite(losses[i].value))
      throw TrainingDiverged(fmt::format("training has diverged: the {} loss of step {} is {}; lower the learning rate",
                                         names_[i], steps(), losses[i].value));
    sums_[i] += losses[i].value;
  }
  ++summed_;
  const std::uint64_t every = std::max<std::uint64_t>(1, (last_step_ + curve_points - 1) / curve_points);
  if (steps() % every != 0 && !finished()) return;
  for (double& sum : sums_) sum /= static_cast<double>(summed_);
  curve_.push_back({steps(), sums_});
  std::fill(sums_.begin(), sums_.end(), 0.0);
  summed_ = 0;
}

std::string OfflineTraining::checkpoint() const {
  sct::RecordWriter writer(kind);
  writer.text(description_);
  writer.word(last_step_);
  writer.word(steps());
  writer.word(names_.size());
  for (std::size_t i = 0; i < names_.size(); ++i) {
    writer.text(names_[i]);
    writer.real(sums_[i]);
  }
  writer.word(summed_);
  writer.word(curve_.size());
  for (const auto& point : curve_) {
    writer.word(point.steps);
    for (const double loss : point.losses) writer.real(loss);
  }
  learner_->save(writer);
  return std::move(writer).sealed();
}

void OfflineTraining::restore(std::string_view bytes, const std::string& source) {
  sct::RecordReader reader(bytes, source, kind);
  if (const auto difference = sct::difference_of_runs(reader.text(), description_); !difference.empty())
    throw UsageError(
        fmt::format("the checkpoint is of another run: {}; give that run's settings or start anew", difference));
  // The points of the curve, and where rates fall these too, follow from the number of steps.
  if (const auto steps = reader.steps(); steps != last_step_)
    throw UsageError(
        fmt::format("the checkpoint is of another run: steps = {} there, {} here; give that run's settings "
                    "or start anew",
                    steps, last_step_));
  const auto at = reader.steps();
  if (at > last_step_) reader.wrong("a step beyond the last");
  std::vector<std::string> names;
  std::vector<double> sums;
  const auto losses = reader.count(16);
  for (std::size_t i = 0; i < losses; ++i) {
    names.push_back(reader.text());
    sums.push_back(reader.real());
  }
  if ((at == 0) != names.empty()) reader.wrong("losses without a step, or steps without a loss");
  const auto summed = reader.steps();
  std::vector<LossPoint> curve;
  const auto points = reader.count(8 * (1 + losses));
  for (std::size_t i = 0; i < points; ++i) {
    LossPoint point{reader.steps(), {}};
    for (std::size_t k = 0; k < losses; ++k) point.losses.push_back(reader.real());
    if (point.steps > at || (!curve.empty() && point.steps <= curve.back().steps)) reader.wrong("a curve out of order");
    curve.push_back(std::move(point));
  }
  learner_->load(reader);
  if (learner_->steps() != at) reader.wrong("a learner at another step");
  if (!reader.done()) reader.wrong("bytes too many at its end");
  names_ = std::move(names);
  sums_ = std::move(sums);
  summed_ = summed;
  curve_ = std::move(curve);
}

}  // namespace folk::mpe
