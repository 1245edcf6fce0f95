#pragma once
// Strategies that estimate how the opponent answers and take the better move.

#include <folk/strategies/axelrod/record.h>
#include <folk/strategies/player.h>

#include <array>

namespace folk {

/// Downing's entry of the first tournament: D, D; then the move that pays more if their C after its C and after its D
/// stay as frequent as they were; when both pay the same, the other than its last.
class Downing {
public:
  void start(const MatchStart& match) { payoffs_ = match.payoffs.numbers(); }
  Move move() const;
  void observe(Move own, Move theirs);

private:
  std::array<double, 4> payoffs_{};
  Record record_;
  double after_cooperation_ = 0;  // their C after its C; in round 1 they are taken to answer a C
  double after_defection_ = 0;
};

/// Downing's rule as it entered the second tournament: C; it thinks well of them at first.
class RevisedDowning {
public:
  Move move() const { return move_; }
  void observe(Move own, Move theirs);

private:
  Record record_;
  std::array<double, 2> answers_{};  // their C after its C, after its D
  std::array<double, 2> asked_{};
  std::array<double, 2> cooperation_{1, 0};
  Move move_ = Move::C;
};

/// Adaptive: C six times, D five times; then the move that has earned more so far.
class Adaptive {
public:
  void start(const MatchStart& match) { payoffs_ = match.payoffs.numbers(); }
  Move move() const {
    if (rounds_ < 11) return rounds_ < 6 ? Move::C : Move::D;
    return earned_[0] > earned_[1] ? Move::C : Move::D;
  }
  void observe(Move own, Move theirs) {
    earned_[bit(own)] += payoffs_[2 * bit(own) + bit(theirs)];
    if (rounds_ < 11) ++rounds_;
  }

private:
  std::array<double, 4> payoffs_{};
  std::array<double, 2> earned_{};  // by own move
  unsigned rounds_ = 0;
};

/// Adaptive Tit For Tat: C while the world looks at least half good; each round it moves half way to their move. In
/// exact numbers tit_for_tat; in doubles, as here, some fifty C in a row are as good as for ever, and a D is forgiven.
class AdaptiveTitForTat {
public:
  Move move() const { return first_ || world_ >= 0.5 ? Move::C : Move::D; }
  void observe(Move, Move theirs) {
    world_ += theirs == Move::C ? 0.5 * (1 - world_) : -0.5 * world_;
    first_ = false;
  }

private:
  double world_ = 0.5;
  bool first_ = true;
};

}  // namespace folk
