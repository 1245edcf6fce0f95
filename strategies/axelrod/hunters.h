#pragma once
// Hunters: each cooperates until the opponent looks like one of a kind of simple strategy, and defects against that.

#include <folk/strategies/axelrod/record.h>

#include <array>
#include <cstdint>

namespace folk {

/// Against who has played nothing but `prey` in at least four rounds.
template <Move prey>
class ConstantHunter {
public:
  Move move() const { return rounds_ >= 4 && constant_ ? Move::D : Move::C; }
  void observe(Move, Move theirs) {
    if (rounds_ < 4) ++rounds_;
    if (theirs != prey) constant_ = false;
  }

private:
  std::uint8_t rounds_ = 0;
  bool constant_ = true;
};

/// Against who has alternated in the first six rounds.
class AlternatorHunter {
public:
  Move move() const { return rounds_ >= 6 && alternates_ ? Move::D : Move::C; }
  void observe(Move, Move theirs) {
    if (rounds_ == 6) return;
    if (rounds_ > 0 && theirs == last_) alternates_ = false;
    ++rounds_;
    last_ = rounds_ == 6 ? Move::C : theirs;
  }

private:
  std::uint8_t rounds_ = 0;
  bool alternates_ = true;
  Move last_ = Move::C;
};

/// For ever against who has once played a cycle of three to twelve moves, not all equal, from the first round on.
class CycleHunter {
public:
  Move move() const { return found_ ? Move::D : Move::C; }
  void observe(Move, Move theirs);

private:
  Moves theirs_;
  bool found_ = false;
};

/// Looks every ten rounds whether they cycle from round 11 on; never against who has played only C.
class EventualCycleHunter {
public:
  Move move() const;
  void observe(Move, Move theirs);

private:
  Moves theirs_;
  bool found_ = false;
};

/// Against who keeps one ratio of C to D: both sides' C in the two halves and the middle of the match are as frequent.
class MathConstantHunter {
public:
  Move move() const;
  void observe(Move own, Move theirs) { record_.add(own, theirs); }

private:
  double cooperation(std::size_t from, std::size_t to) const;

  Record record_;
};

/// Against who answers its C by C, and its D by D, in about half of the cases.
class RandomHunter {
public:
  Move move() const;
  void observe(Move own, Move theirs);

private:
  Record record_;
  std::size_t cooperation_answered_ = 0;  // their C after its C
  std::size_t defection_answered_ = 0;    // their D after its D
};

/// Meta Hunter: a team of the above, each of which takes its own proposals for what was played. D when one of them says
/// so; else C for 100 rounds, then tit_for_tat. The aggressive one has the hunter of cooperators in the team.
template <bool aggressive>
class MetaHunter {
public:
  Move move() const {
    for (const Move proposal : proposals())
      if (proposal == Move::D) return Move::D;
    return theirs_.size() > 100 ? theirs_.last() : Move::C;
  }
  void observe(Move, Move theirs) {
    const auto proposal = proposals();
    defectors_.observe(proposal[0], theirs);
    alternators_.observe(proposal[1], theirs);
    random_.observe(proposal[2], theirs);
    constants_.observe(proposal[3], theirs);
    cycles_.observe(proposal[4], theirs);
    eventual_cycles_.observe(proposal[5], theirs);
    cooperators_.observe(proposal[6], theirs);
    theirs_.add(theirs);
  }

private:
  std::array<Move, 7> proposals() const {
    return {defectors_.move(),
            alternators_.move(),
            random_.move(),
            constants_.move(),
            cycles_.move(),
            eventual_cycles_.move(),
            aggressive ? cooperators_.move() : Move::C};
  }

  ConstantHunter<Move::D> defectors_;
  AlternatorHunter alternators_;
  RandomHunter random_;
  MathConstantHunter constants_;
  CycleHunter cycles_;
  EventualCycleHunter eventual_cycles_;
  ConstantHunter<Move::C> cooperators_;
  Moves theirs_;
};

}  // namespace folk
