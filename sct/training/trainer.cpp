#include <folk/games/error.h>
#include <folk/sct/network/initial_parameters.h>
#include <folk/sct/training/trainer.h>

#include <algorithm>
#include <utility>

namespace folk::sct {
namespace {

constexpr std::uint64_t window_role = 17;  // of the random key; initial parameters have 16

}  // namespace

Trainer::Trainer(const TrainingSettings& settings, std::vector<Lesson> lessons)
    : settings_(settings),
      lessons_(std::move(lessons)),
      network_(std::make_unique<Network<float>>(settings.architecture)),
      batch_gradient_(*network_, settings.mode, std::max(1U, settings.threads)),
      gradient_(network_->layout().size()) {
  settings_.windows.time_rows = settings.architecture.time_rows;
  settings_.windows.remembered = settings.architecture.observation_size / observation_size;
  state_.parameters = initial_parameters(settings.architecture, settings.seed);
  if (settings.averaging > 0) state_.average = state_.parameters;
  state_.optimiser.first.resize(gradient_.size());
  state_.optimiser.second.resize(gradient_.size());
}

Losses Trainer::step() {
  const std::uint64_t now = steps();
  RandomStream random({settings_.seed, now, 0, window_role});
  const auto batch = draw_windows(lessons_, settings_.windows, random);
  const auto losses = batch_gradient_(state_.parameters, batch, {settings_.dropout, settings_.seed, now}, gradient_);
  adamw_step<float>(settings_.optimiser, batch_gradient_.touched(), gradient_, state_.optimiser, state_.parameters);
  if (!state_.average.empty()) {
    // The first steps weigh less, so that the start is forgotten (as in TensorFlow's exponential moving average).
    const double steps = static_cast<double>(now + 1);
    const auto decay = static_cast<float>(std::min(settings_.averaging, steps / (steps + 9)));
    for (std::size_t i = 0; i < state_.average.size(); ++i)
      state_.average[i] += (1 - decay) * (state_.parameters[i] - state_.average[i]);
  }
  return losses;
}

void Trainer::restore(TrainingState state) {
  const auto size = gradient_.size();
  const auto average = settings_.averaging > 0 ? size : 0;
  if (state.parameters.size() != size || state.average.size() != average || state.optimiser.first.size() != size ||
      state.optimiser.second.size() != size)
    throw UsageError("the checkpoint is of a run with another network: start anew or give that run's settings");
  state_ = std::move(state);
}

}  // namespace folk::sct
