#include <folk/tools/sct_train/training_progress.h>

#include <folk/tools/program/progress.h>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include <unistd.h>

namespace folk::tools {

TrainProgress::TrainProgress(bool enabled, std::string label, std::uint64_t first_step, std::uint64_t steps,
                             std::uint64_t step_tokens)
    : enabled_(enabled),
      redraws_(enabled && ::isatty(STDERR_FILENO) == 1),
      label_(std::move(label)),
      first_step_(first_step),
      steps_(steps),
      step_tokens_(step_tokens) {}

TrainProgress::~TrainProgress() { erase(); }

double TrainProgress::elapsed() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

double TrainProgress::tokens_per_second(std::uint64_t step) const {
  return static_cast<double>((step - first_step_) * step_tokens_) / std::max(training_, 1e-9);
}

/// Evaluations to come take their share as those before did.
double TrainProgress::seconds_left(std::uint64_t step) const {
  return elapsed() / static_cast<double>(std::max<std::uint64_t>(1, step - first_step_)) *
         static_cast<double>(steps_ - step);
}

void TrainProgress::erase() {
  if (drawn_) show("\r\x1b[K");
  drawn_ = false;
}

void TrainProgress::step(const sct::TrainingRun& run) {
  const auto now = Clock::now();
  training_ += std::chrono::duration<double>(now - resumed_).count();
  resumed_ = now;
  if (!redraws_ || now < next_) return;
  next_ = now + std::chrono::milliseconds(200);
  const auto& losses = run.losses();
  std::string line = fmt::format("{}step {} of {}, losses {:.4f} {:.4f}, {:.0f} tokens/s, {} left", label_, run.steps(),
                                 steps_, losses.mean_belief(), losses.mean_action(), tokens_per_second(run.steps()),
                                 duration(seconds_left(run.steps())));
  line.resize(std::min(line.size(), terminal_width() - 1));  // the last column stays free: a terminal may wrap after it
  show("\r" + line + "\x1b[K");
  drawn_ = true;
}

void TrainProgress::evaluation(const sct::TrainingRun& run) {
  resumed_ = Clock::now();
  if (!enabled_) return;
  erase();
  const auto& evaluation = run.history().back();
  const auto& best = sct::best_target(evaluation);
  std::string line =
      fmt::format("{}step {} of {}: belief loss {:.4f}, action loss {:.4f}; asked for {} it earns {:.1f}", label_,
                  evaluation.steps, steps_, evaluation.belief_loss, evaluation.action_loss, best.target, best.total);
  if (best.accuracy) line += fmt::format(", {:.2f} % of its beliefs right", 100 * *best.accuracy);
  if (best.held_out) line += fmt::format(", held out {:.1f}", best.held_out->total);
  if (run.kept() + 1 == run.history().size()) line += " (kept)";
  if (run.steps() > first_step_) {
    line += fmt::format("; {:.0f} tokens/s", tokens_per_second(run.steps()));
    if (!run.finished()) line += fmt::format(", {} left", duration(seconds_left(run.steps())));
  }
  show(line + "\n");
}

}  // namespace folk::tools
