#pragma once
// Entrants of Axelrod's second tournament (Journal of Conflict Resolution 24(3), 1980) that keep counts, as read off
// its Fortran programs by the authors of Axelrod-Python 4.13.0.

#include <folk/strategies/axelrod/last_moves.h>
#include <folk/strategies/axelrod/record.h>
#include <folk/strategies/player.h>

#include <array>
#include <cstdint>

namespace folk {

/// Borufsen: tit_for_tat that plays C after three mutual D, breaks echoes, and every 25 rounds turns to D against who
/// hardly cooperates or seems random.
class Borufsen {
public:
  Move move() const { return move_; }
  void observe(Move own, Move theirs);

private:
  Move decide(Move own, Move theirs, Move own_before, Move theirs_before);
  void judge();
  Move softened(Move move);

  Record record_;
  std::array<unsigned, 2> answers_{};  // their C in the last 25 rounds after its C, after its D
  unsigned mutual_defections_ = 0;
  unsigned echoes_ = 0;
  bool forgives_next_ = false;
  bool defects_ = false;
  Move move_ = Move::C;
};

/// Graaskamp & Katzen: tit_for_tat, but D for ever once its score falls behind at one of six milestones.
class GraaskampKatzen {
public:
  void start(const MatchStart& match) { payoffs_ = match.payoffs.numbers(); }
  Move move() const { return defects_ ? Move::D : last_; }
  void observe(Move own, Move theirs);

private:
  std::array<double, 4> payoffs_{};
  double score_ = 0;
  unsigned rounds_ = 0;
  bool defects_ = false;
  Move last_ = Move::C;
};

/// Richard Hufford: C, tit_for_tat or D by how often they did what it had done before; a D to test who has played C for
/// long.
class Hufford {
public:
  Move move() const { return move_; }
  void observe(Move own, Move theirs);

private:
  Move by_agreement(Move theirs) const;

  Record record_;
  std::int64_t agreements_ = 2;
  LastMoves<4> disagreements_;  // D: they did not do what it had done
  std::int64_t streak_needed_ = 21;
  std::int64_t streak_ = 2;
  std::int64_t last_test_ = 0;  // its round; 0: none is under way
  std::int64_t cooperated_after_test_ = 2;
  std::int64_t defected_after_test_ = 2;
  Move move_ = Move::C;
};

/// Rowsam: C, but looks every six rounds at what it earns: a D, C, D when that is little, and D for ever when it has
/// been little too often.
class Rowsam {
public:
  void start(const MatchStart& match) { payoffs_ = match.payoffs.numbers(); }
  Move move() const { return move_; }
  void observe(Move own, Move theirs);

private:
  unsigned distrust() const;

  std::array<double, 4> payoffs_{};
  double score_ = 0;
  std::int64_t rounds_ = 0;
  unsigned distrust_ = 0;
  unsigned cycle_left_ = 0;  // moves of C, D to come
  bool defects_ = false;
  Move move_ = Move::C;
};

/// Tideman & Chieruzzi: D while its lead is less than a bound that each new D of theirs raises; now and then a fresh
/// start.
class SecondTidemanChieruzzi {
public:
  void start(const MatchStart& match) { payoffs_ = match.payoffs.numbers(); }
  Move move() const { return move_; }
  void observe(Move own, Move theirs);

private:
  std::array<double, 4> payoffs_{};
  double lead_ = 0;
  double bound_ = 0;
  double raise_ = 0;
  std::int64_t rounds_ = 0;
  std::int64_t defections_ = 0;
  std::int64_t last_start_ = 0;
  bool starting_ = false;
  Move before_ = Move::C;
  Move move_ = Move::C;
};

/// Weiner: tit_for_tat that at times forgives a D that follows an odd run of D, and defects while five of the last
/// twelve moves before the last were D.
class Weiner {
public:
  Move move() const { return move_; }
  void observe(Move own, Move theirs);

private:
  LastMoves<12> before_last_;
  Move last_ = Move::C;
  std::int64_t rounds_ = 0;
  bool may_forgive_ = false;
  std::int64_t grudge_ = 0;
  unsigned run_ = 0;  // of D
  Move move_ = Move::C;
};

/// White: C for ten rounds, then D after a D when their D times the whole part of the round's logarithm reach the
/// round.
class White {
public:
  Move move() const;
  void observe(Move, Move theirs) { theirs_.add(theirs); }

private:
  Moves theirs_;
};

/// Yamachi: plays what they have played more often after the same move of theirs and the same answer of its own; from
/// round 41 on D against who plays D in about half of the rounds.
class Yamachi {
public:
  Move move() const;
  void observe(Move own, Move theirs);

private:
  Moves theirs_;
  Moves predictions_;
  std::array<std::int64_t, 8> counts_{};  // of their move, its prediction of the next, their next move
  Move predicted_ = Move::C;
};

}  // namespace folk
