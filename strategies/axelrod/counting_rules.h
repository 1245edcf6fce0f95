#pragma once
// Strategies with one unbounded count, for CountingMachine.

#include <folk/strategies/axelrod/last_moves.h>

#include <algorithm>
#include <cstdint>

namespace folk {

/// Limited Retaliate: D while it was the sucker more often than temptation_weight / sucker_weight of the times it was
/// tempted, but no more than `limit` such D in a row. The count weighs both.
template <int sucker_weight, int temptation_weight, int limit>
class LimitedRetaliate {
public:
  static constexpr std::int64_t threshold = 1;

  Move move() const { return retaliations_ > 0 ? Move::D : Move::C; }
  std::int64_t adds(Move own, Move theirs) const {
    return own == theirs ? 0 : own == Move::C ? sucker_weight : -temptation_weight;
  }
  void observe(Move, Move, bool reached) {
    const bool retaliates = reached && retaliations_ < limit;
    retaliations_ = retaliates ? static_cast<std::uint8_t>(retaliations_ + 1) : 0;
  }

private:
  std::uint8_t retaliations_ = 0;  // in a row, the coming one with them
};

/// Gladstein's entry of the second tournament, called tester in the article: D; while they never retaliate, D as often
/// as its own C are more than a half; after their first D one C, then tit_for_tat. It counts its own C less its D.
class Gladstein {
public:
  static constexpr std::int64_t threshold = 1;

  Move move() const { return move_; }
  std::int64_t adds(Move own, Move) const { return own == Move::C ? 1 : -1; }
  void observe(Move, Move theirs, bool reached) {
    if (!patsy_) {
      move_ = theirs;
    } else if (theirs == Move::D) {
      patsy_ = false;
      move_ = Move::C;
    } else {
      move_ = reached ? Move::D : Move::C;
    }
  }

private:
  bool patsy_ = true;
  Move move_ = Move::D;
};

/// OmegaTFT: tit_for_tat that breaks out of alternating retaliation and gives up on who seems random, which it counts.
class OmegaTitForTat {
public:
  static constexpr std::int64_t threshold = 8;

  Move move() const { return move_; }

  std::int64_t adds(Move own, Move theirs) const {
    if (theirs_.length() == 0 || breaks_out()) return 0;
    const Move before = theirs_.last();
    const std::int64_t randomness = (theirs != before ? 1 : 0) + (theirs != own ? 1 : 0);
    return theirs == Move::C && before == Move::C ? randomness - 1 : randomness;
  }

  void observe(Move, Move theirs, bool reached) {
    const bool opening = theirs_.length() == 0;
    const bool alternated = !opening && theirs != theirs_.last();
    theirs_.add(theirs);
    if (breaks_out()) {  // two C
      deadlock_ = deadlock_ == deadlocked ? deadlocked + 1 : 0;
      move_ = Move::C;
    } else if (reached) {
      move_ = Move::D;
    } else {
      move_ = theirs;
      deadlock_ = alternated ? static_cast<std::uint8_t>(deadlock_ + 1) : 0;
    }
  }

private:
  static constexpr std::uint8_t deadlocked = 3;

  bool breaks_out() const { return deadlock_ >= deadlocked; }

  LastMoves<1, std::uint8_t> theirs_;
  std::uint8_t deadlock_ = 0;
  Move move_ = Move::C;
};

/// Mikkelson's entry of the second tournament: gives credit, one for a C, less two for a D; when it is used up, D early
/// on, later only against who defects in 15 % of the rounds: it counts 20 for a D, less 3 for a round.
class Mikkelson {
public:
  static constexpr std::int64_t threshold = 3;  // the coming round is one more

  Move move() const { return move_; }
  std::int64_t adds(Move, Move theirs) const { return theirs == Move::D ? 17 : -3; }

  void observe(Move, Move theirs, bool reached) {
    if (rounds_ < 10) ++rounds_;
    credit_ = static_cast<std::int8_t>(theirs == Move::C ? std::min(credit_ + 1, 8) : std::max(credit_ - 2, -7));
    if (rounds_ == 1 || credit_ > 0) {
      move_ = Move::C;
    } else if (rounds_ < 10) {
      credit_ = 4;
      move_ = Move::D;
    } else {
      move_ = reached ? Move::D : Move::C;
    }
  }

private:
  std::int8_t credit_ = 7;
  std::uint8_t rounds_ = 0;  // up to 10
  Move move_ = Move::C;
};

}  // namespace folk
