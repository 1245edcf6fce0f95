#pragma once
// Entrants of Axelrod's first tournament (Journal of Conflict Resolution 24, 1980) that keep counts, as the article
// describes them and Axelrod-Python 4.13.0 fills its gaps. (Downing, Shubik and Tullock are with their kin.)

#include <folk/games/random.h>
#include <folk/strategies/axelrod/record.h>
#include <folk/strategies/player.h>

#include <array>
#include <cstdint>

namespace folk {

/// Whether counts of C and D pass for tosses of a fair coin: chi squared of one degree of freedom at 5 %.
bool looks_random(std::size_t cooperations, std::size_t defections);

/// Stein & Rapoport: C for four rounds, then tit_for_tat; every 15 rounds it decides whether they play at random, and
/// if so it defects for the next 15.
class SteinRapoport {
public:
  Move move() const { return rounds_ < 4 ? Move::C : random_ ? Move::D : last_; }
  void observe(Move, Move theirs);

private:
  std::uint64_t rounds_ = 0;
  std::uint64_t defections_ = 0;
  bool random_ = false;
  Move last_ = Move::C;
};

/// Tideman & Chieruzzi: retaliates with one D more each time, but offers a fresh start, C, C, to who is ten points
/// behind, does not seem random and has just played C, not within 20 rounds of the last one.
class TidemanChieruzzi {
public:
  void start(const MatchStart& match) { payoffs_ = match.payoffs.numbers(); }
  Move move() const { return move_; }
  void observe(Move own, Move theirs);

private:
  bool may_start_afresh(Move theirs) const;

  std::array<double, 4> payoffs_{};
  double lead_ = 0;  // own score less theirs
  std::uint64_t rounds_ = 0;
  std::uint64_t last_start_ = 0;  // the round of the last fresh start
  bool starting_ = false;         // a fresh start has begun: its second C comes
  std::uint64_t defections_ = 0;  // since then
  std::uint64_t length_ = 0;      // of the last retaliation
  std::uint64_t left_ = 0;        // D to play after the coming one
  Move move_ = Move::C;
};

/// Feld: tit_for_tat that plays D after their C with a probability that grows to 1/2 in 200 rounds.
class Feld {
public:
  double cooperation() const {
    if (rounds_ == 0) return 1;
    return last_ == Move::D ? 0 : 1 - 0.5 * rounds_ / 200;
  }
  void observe(Move, Move theirs) {
    if (rounds_ < 200) ++rounds_;
    last_ = theirs;
  }

private:
  std::uint8_t rounds_ = 0;
  Move last_ = Move::C;
};

/// Graaskamp: tit_for_tat but for a D in round 51; from round 57 on D against who seems random, tit_for_tat with
/// tit_for_tat and with its own like, and with others C but for a D every 5 to 15 rounds.
class Graaskamp {
public:
  void start(const MatchStart& match) { random_numbers_ = RandomStream(match.random); }
  Move move();
  void observe(Move own, Move theirs);

private:
  std::uint64_t rounds_after_next_defection();

  RandomStream random_numbers_;
  Record record_;
  bool copies_ = true;  // their every move was its last one
  bool equals_ = true;  // their every move was its own of that round
  bool random_ = false;
  std::uint64_t next_defection_ = 0;  // rounds played before it; 0: not yet drawn
};

/// Calculator, of PRISON: joss for 20 rounds; then D if they have played a cycle, else tit_for_tat.
class Calculator {
public:
  void start(const MatchStart& match) { random_numbers_ = RandomStream(match.random); }
  Move move();
  void observe(Move own, Move theirs);

private:
  RandomStream random_numbers_;
  Moves theirs_;
  bool cycles_ = false;
};

}  // namespace folk
