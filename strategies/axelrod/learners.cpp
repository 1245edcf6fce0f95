#include <folk/strategies/axelrod/learners.h>

#include <algorithm>

namespace folk {

Move Downing::move() const {
  if (record_.rounds() < 2) return Move::D;
  const double alpha = after_cooperation_ / (static_cast<double>(record_.own.cooperations()) + 1);
  const double beta = after_defection_ / std::max(static_cast<double>(record_.own.defections()), 2.0);
  const auto [reward, sucker, temptation, punishment] = payoffs_;
  const double cooperating = alpha * reward + (1 - alpha) * sucker;
  const double defecting = beta * temptation + (1 - beta) * punishment;
  if (cooperating == defecting) return other(record_.own.last());
  return cooperating > defecting ? Move::C : Move::D;
}

void Downing::observe(Move own, Move theirs) {
  if (theirs == Move::C) {
    const bool after_c = record_.rounds() == 0 || record_.own.last() == Move::C;
    ++(after_c ? after_cooperation_ : after_defection_);
  }
  record_.add(own, theirs);
}

void RevisedDowning::observe(Move own, Move theirs) {
  if (record_.rounds() > 0) {
    const unsigned asked = bit(record_.own.last());
    answers_[asked] += theirs == Move::C ? 1 : 0;
    ++asked_[asked];
    cooperation_[asked] = answers_[asked] / asked_[asked];
  }
  record_.add(own, theirs);
  const auto [good, bad] = cooperation_;
  const double cooperating = 6 * good - 8 * bad - 2;
  const double alternating = 4 * good - 5 * bad - 1;
  if (cooperating >= 0 && cooperating >= alternating) {
    move_ = Move::C;
  } else {
    move_ = alternating >= 0 ? other(own) : Move::D;
  }
}

}  // namespace folk
