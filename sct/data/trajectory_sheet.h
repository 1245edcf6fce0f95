#pragma once
// A match as it is played, written down as data to learn from.

#include <folk/analysis/play/side_by_side.h>
#include <folk/games/seat.h>
#include <folk/sct/data/trajectory.h>

#include <array>
#include <utility>

namespace folk::sct {

/// The view of the player in one seat: the sheet of a MatchSink, or half of it.
class TrajectorySheet {
public:
  /// `payoffs` by outcome.
  TrajectorySheet(const SeatedMatch& match, Seat seat, const std::array<double, 4>& payoffs)
      : seat_(seat),
        payoffs_(payoffs),
        trajectory_{match.contest().strategy(seat).name, match.contest().strategy(other(seat)).name, {}, {}, {}} {}

  void round(const SeatedMatch&, const PlayedRound& round) {
    const Outcome seen = seat_ == Seat::first ? Outcome(round) : round.exchanged();
    trajectory_.add(seen.own, seen.theirs, payoffs_[seen.index()]);
  }

  Trajectory take() { return std::move(trajectory_); }

private:
  Seat seat_;
  std::array<double, 4> payoffs_;
  Trajectory trajectory_;
};

}  // namespace folk::sct
