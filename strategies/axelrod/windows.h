#pragma once
// Finite strategies that look at a window of their last moves.

#include <folk/strategies/axelrod/last_moves.h>

namespace folk {

/// Majority of their last `window` moves; a tie is C for the soft, D for the hard one.
template <unsigned window, Move at_tie>
class WindowMajority {
public:
  Move move() const {
    if (theirs_.cooperations() == theirs_.defections()) return at_tie;
    return theirs_.cooperations() > theirs_.defections() ? Move::C : Move::D;
  }
  void observe(Move, Move theirs) { theirs_.add(theirs); }

private:
  LastMoves<window> theirs_;
};

/// ShortMem: C for ten rounds and the next; then what leads by three or more among their last ten, else their last.
class ShortMemory {
public:
  Move move() const {
    if (rounds_ <= 10) return Move::C;
    const int lead = static_cast<int>(theirs_.cooperations()) - static_cast<int>(theirs_.defections());
    return lead >= 3 ? Move::C : lead <= -3 ? Move::D : theirs_.last();
  }
  void observe(Move, Move theirs) {
    theirs_.add(theirs);
    if (rounds_ <= 10) ++rounds_;
  }

private:
  LastMoves<10, std::uint16_t> theirs_;
  std::uint16_t rounds_ = 0;
};

/// Grofman's entry of the second tournament: counts their D in the seven rounds before the last.
class SecondGrofman {
public:
  Move move() const {
    const unsigned rounds = theirs_.length();
    if (rounds < 2) return Move::C;
    if (rounds < 7) return theirs_.last();
    const unsigned defections = theirs_.defections() - bit(theirs_.last());
    return defections <= (own_.last() == Move::C ? 2U : 1U) ? Move::C : Move::D;
  }
  void observe(Move own, Move theirs) {
    own_.add(own);
    theirs_.add(theirs);
  }

private:
  LastMoves<1, std::uint16_t> own_;
  LastMoves<8, std::uint16_t> theirs_;
};

/// Tullock's entry of the first tournament: C for 11 rounds, then a tenth less often than they did in the last ten.
class Tullock {
public:
  double cooperation() const {
    if (rounds_ < 11) return 1;
    const unsigned cooperations = theirs_.cooperations();
    return cooperations == 0 ? 0 : (cooperations - 1) / 10.0;
  }
  void observe(Move, Move theirs) {
    theirs_.add(theirs);
    if (rounds_ < 11) ++rounds_;
  }

private:
  LastMoves<10, std::uint16_t> theirs_;
  std::uint16_t rounds_ = 0;
};

}  // namespace folk
