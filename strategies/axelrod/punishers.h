#pragma once
// Strategies whose punishments grow, shrink or run out.

#include <folk/games/move.h>

#include <algorithm>
#include <cstdint>

namespace folk {

/// Punisher: answers a D by a D and as many more as the twentieths of rounds in which they have played D (the inverse
/// one: C, at least one). What they do meanwhile is only counted.
template <Move counted>
class ProportionalPunisher {
public:
  Move move() const { return move_; }
  void observe(Move, Move theirs) {
    ++rounds_;
    if (theirs == counted) ++count_;
    if (left_ > 0) {
      --left_;
      move_ = Move::D;
    } else {
      if (theirs == Move::D) left_ = std::max<std::int64_t>(count_ * 20 / rounds_, counted == Move::C ? 1 : 0);
      move_ = theirs;
    }
  }

private:
  std::int64_t rounds_ = 0;
  std::int64_t count_ = 0;
  std::int64_t left_ = 0;
  Move move_ = Move::C;
};

/// Tricky Level Punisher: D while more than a twentieth of their moves were D, for the first hundred rounds; then C.
/// (It is described with a fifth before round 10 and a tenth before round 50, which the twentieth includes.)
class TrickyLevelPunisher {
public:
  Move move() const { return rounds_ < 100 && 20 * defections_ > rounds_ ? Move::D : Move::C; }
  void observe(Move, Move theirs) {
    if (rounds_ == 100) return;
    ++rounds_;
    if (theirs == Move::D) ++defections_;
    if (rounds_ == 100) defections_ = 0;
  }

private:
  std::uint8_t rounds_ = 0;
  std::uint8_t defections_ = 0;
};

/// Shubik's entry of the first tournament: each time they play D against its C, it plays D once more than before.
class Shubik {
public:
  Move move() const { return move_; }
  void observe(Move own, Move theirs) {
    if (left_ > 0) {
      --left_;
    } else if (own == Move::C && theirs == Move::D) {
      left_ = length_++;
      move_ = Move::D;
    } else {
      move_ = Move::C;
    }
  }

private:
  std::int64_t length_ = 0;  // of the last retaliation
  std::int64_t left_ = 0;    // D to play after the coming one
  Move move_ = Move::C;
};

}  // namespace folk
