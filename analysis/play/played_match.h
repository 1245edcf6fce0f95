#pragma once
// The outcomes and guesses of one match, added up round by round.

#include <folk/analysis/play/pair_result.h>
#include <folk/analysis/play/side_by_side.h>
#include <folk/games/criterion.h>
#include <folk/games/seat.h>

#include <array>
#include <cmath>

namespace folk {

/// The sheet of one match, on which rounds weigh what they do under a criterion.
class PlayedMatch {
public:
  PlayedMatch(const Contest& contest, const Criterion& criterion);

  void round(const SeatedMatch& match, const PlayedRound& round) {
    judge_belief(match, Seat::first, round.theirs);
    judge_belief(match, Seat::second, round.own);
    weights_[round.index()] += weight_;
    weight_ *= continuation_;
  }

  /// Of the rounds played so far.
  OutcomeWeights weights() const;
  Guesses guesses(Seat seat) const;

private:
  void judge_belief(const SeatedMatch& match, Seat seat, Move theirs) {
    if (!may_believe_[index(seat)]) return;
    const auto belief = match.player(seat).belief();
    if (!belief) return;
    const double given = theirs == Move::C ? *belief : 1 - *belief;
    guesses_[index(seat)] +=
        {likelier_move(*belief) == theirs ? weight_ : 0, weight_, weight_ > 0 ? -weight_ * std::log(given) : 0};
  }

  std::array<bool, 2> may_believe_;  // machines never do
  double scale_ = 1;                 // what a round weighs is scale_ * continuation_^(t-1)
  double continuation_ = 1;
  double weight_ = 1;  // of the coming round; this and what it is added to still want scale_
  OutcomeWeights weights_{};
  std::array<Guesses, 2> guesses_{};
};

}  // namespace folk
