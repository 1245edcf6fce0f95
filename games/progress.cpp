#include <folk/games/progress.h>

#include <cmath>

namespace folk {

Progress::Progress()
    : Progress(std::make_shared<State>(nullptr, nullptr)) {}

void Progress::cancel() const {
  if (state_) state_->cancelled = true;
}

bool Progress::cancelled() const {
  if (!state_) return false;
  // An answer is remembered, so that all threads hear the same.
  if (!state_->cancelled && state_->stop && state_->stop()) state_->cancelled = true;
  return state_->cancelled;
}

void Progress::check() const {
  if (cancelled()) throw Cancelled();
}

void Progress::operator()(double share) const {
  if (!state_) return;
  const double whole = std::lerp(begin_, end_, share);
  if (whole < 1 ? cancelled() : state_->cancelled.load()) throw Cancelled();
  if (state_->told) state_->told(whole);
  if (state_->cancelled) throw Cancelled();
}

Progress Progress::part(double begin, double end) const {
  Progress stage = *this;
  stage.begin_ = std::lerp(begin_, end_, begin);
  stage.end_ = std::lerp(begin_, end_, end);
  return stage;
}

}  // namespace folk
