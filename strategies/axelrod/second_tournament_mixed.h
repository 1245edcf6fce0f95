#pragma once
// Entrants of Axelrod's second tournament that mix, each as P(C) of the coming round, as read off its Fortran programs
// by the authors of Axelrod-Python 4.13.0.

#include <folk/strategies/axelrod/last_moves.h>
#include <folk/strategies/axelrod/record.h>

#include <array>
#include <cmath>
#include <cstdint>

namespace folk {

/// Champion: C ten times, tit_for_tat to round 25; then D after a D as often as they defect, if that is often.
class SecondChampion {
public:
  double cooperation() const {
    const std::size_t rounds = theirs_.size();
    if (rounds < 10 || theirs_.last() == Move::C) return 1;
    if (rounds < 25) return 0;
    const double defection = static_cast<double>(theirs_.defections()) / static_cast<double>(rounds);
    return defection >= 0.4 ? 1 - defection : 1;
  }
  void observe(Move, Move theirs) { theirs_.add(theirs); }

private:
  Moves theirs_;
};

/// Eatherley: D after a D as often as they defect.
class Eatherley {
public:
  double cooperation() const {
    if (theirs_.size() == 0 || theirs_.last() == Move::C) return 1;
    return static_cast<double>(theirs_.cooperations()) / static_cast<double>(theirs_.size());
  }
  void observe(Move, Move theirs) { theirs_.add(theirs); }

private:
  Moves theirs_;
};

/// Leyvraz: by their last three moves, which are taken to have been C before the match.
class Leyvraz {
public:
  double cooperation() const {
    constexpr std::array<double, 8> table{1, 0.5, 0, 0.25, 1, 1, 1, 0.25};  // oldest move highest, D = 1
    return table[4U * bit(third_last_) + 2U * bit(second_last_) + bit(last_)];
  }
  void observe(Move, Move theirs) {
    third_last_ = second_last_;
    second_last_ = last_;
    last_ = theirs;
  }

private:
  Move third_last_ = Move::C;
  Move second_last_ = Move::C;
  Move last_ = Move::C;
};

/// Black: C five times; then by the number of D in their last five moves.
class Black {
public:
  double cooperation() const {
    constexpr std::array<double, 6> table{1, 1, 0.88, 0.68, 0.4, 0.04};
    return theirs_.length() < 5 ? 1 : table[theirs_.defections()];
  }
  void observe(Move, Move theirs) { theirs_.add(theirs); }

private:
  LastMoves<5, std::uint8_t> theirs_;
};

/// Getzler: D with a probability to which each D of theirs adds a half of what it added a round before.
class Getzler {
public:
  double cooperation() const { return 1 - defection_; }
  void observe(Move, Move theirs) { defection_ = (defection_ + bit(theirs)) * 0.5; }

private:
  double defection_ = 0;
};

/// Cave: D for certain against who defects often, by three bounds; else D after every second D, and after each
/// beyond 17.
class Cave {
public:
  double cooperation() const {
    const std::size_t round = theirs_.size() + 1;
    if (round == 1) return 1;
    const std::size_t defections = theirs_.defections();
    const double share = static_cast<double>(defections) / static_cast<double>(round);
    if ((round > 39 && share > 0.39) || (round > 29 && share > 0.65) || (round > 19 && share > 0.79)) return 0;
    if (theirs_.last() == Move::C) return 1;
    return defections > 17 ? 0 : 0.5;
  }
  void observe(Move, Move theirs) { theirs_.add(theirs); }

private:
  Moves theirs_;
};

/// William Adams: D at their fourth, seventh and ninth D, not counting one in round 1; later C after a D with a
/// probability that each further D halves.
class WilliamAdams {
public:
  double cooperation() const {
    if (theirs_.size() <= 1) return 1;
    const std::size_t counted = theirs_.defections() - bit(theirs_[0]);
    if (counted == 4 || counted == 7 || counted == 9) return 0;
    if (counted < 9 || theirs_.last() == Move::C) return 1;
    return std::pow(0.5, static_cast<double>(counted - 9));
  }
  void observe(Move, Move theirs) { theirs_.add(theirs); }

private:
  Moves theirs_;
};

/// Kluepfel: by the run in their last three moves; from round 28 on D against who answers its C and its D alike, within
/// one and a half standard deviations.
class Kluepfel {
public:
  double cooperation() const {
    if (rounds_ > 26 && as_by_chance(answered_[1][0], answered_[1][1]) &&
        as_by_chance(answered_[0][1], answered_[0][0]))
      return 0;
    if (last_ == second_last_) {
      const double follows = last_ == third_last_ ? 1 : 0.9;
      return last_ == Move::C ? follows : 1 - follows;
    }
    return last_ == Move::C ? 0.7 : 0.4;
  }
  void observe(Move own, Move theirs) {
    if (rounds_ > 0) ++answered_[bit(own_)][bit(theirs)];
    ++rounds_;
    own_ = own;
    third_last_ = second_last_;
    second_last_ = last_;
    last_ = theirs;
  }

private:
  /// Whether the first are not much fewer than the second.
  static bool as_by_chance(double first, double second) {
    return first >= (first + second) / 2 - 0.75 * std::sqrt(first + second);
  }

  std::array<std::array<double, 2>, 2> answered_{};  // by its move, their next move
  std::uint64_t rounds_ = 0;
  Move own_ = Move::C;
  Move last_ = Move::C;
  Move second_last_ = Move::C;
  Move third_last_ = Move::C;
};

/// Appold: C four times and after their first D from then on; then C as often as they answered its move before the last
/// by C.
class Appold {
public:
  double cooperation() const { return rounds_ < 4 || forgives_ ? 1 : answers_[bit(asked_)] / times_[bit(asked_)]; }
  void observe(Move own, Move theirs) {
    ++rounds_;
    asked_ = own_;
    own_ = own;
    ++times_[bit(asked_)];
    if (theirs == Move::C) ++answers_[bit(asked_)];
    forgives_ = rounds_ >= 4 && theirs == Move::D && !forgave_;
    forgave_ = forgave_ || forgives_;
  }

private:
  std::array<double, 2> answers_{0, 1};  // their C after its C, after its D
  std::array<double, 2> times_{0, 1};
  std::uint64_t rounds_ = 0;
  Move own_ = Move::C;    // its last move
  Move asked_ = Move::C;  // the one before, to which their last move answered
  bool forgives_ = false;
  bool forgave_ = false;
};

}  // namespace folk
