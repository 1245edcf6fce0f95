#include <folk/analysis/play/played_match.h>

namespace folk {

PlayedMatch::PlayedMatch(const Contest& contest, const Criterion& criterion)
    : may_believe_{!contest.first->machine, !contest.second->machine} {
  switch (criterion.kind()) {
    case Criterion::Kind::finite: break;
    case Criterion::Kind::mean: scale_ = 1.0 / static_cast<double>(long_run_rounds); break;
    case Criterion::Kind::discounted:
      continuation_ = criterion.continuation();
      scale_ = 1 - continuation_;
      break;
    case Criterion::Kind::ending:
      // A drawn length weighs by itself.
      if (contest.once) continuation_ = criterion.continuation();
  }
}

OutcomeWeights PlayedMatch::weights() const {
  OutcomeWeights scaled = weights_;
  for (double& weight : scaled) weight *= scale_;
  return scaled;
}

Guesses PlayedMatch::guesses(Seat seat) const {
  const Guesses& sum = guesses_[index(seat)];
  return {sum.right * scale_, sum.all * scale_, sum.log_loss * scale_};
}

}  // namespace folk
