#pragma once
// Finite strategies that sort the opponent into a class and play against the class.

#include <folk/strategies/axelrod/last_moves.h>

#include <array>
#include <cstdint>
#include <cstdlib>

namespace folk {

/// Adaptive Pavlov: tit_for_tat for six rounds, then every six rounds it sorts the opponent anew by the last six moves.
class AdaptivePavlov {
protected:
  enum class Kind : std::uint8_t { unknown, cooperative, defector, mistrustful, pavlov, random };

  /// Whether six rounds are complete now, after this move of theirs.
  bool counts_six(Move theirs) {
    theirs_.add(theirs);
    phase_ = phase_ == 11 ? 6 : static_cast<std::uint8_t>(phase_ + 1);
    return phase_ == 6;
  }
  bool first_six() const { return phase_ < 6; }
  /// Rounds since it last sorted.
  unsigned since() const { return phase_ - 6U; }
  Move tit_for_tat() const { return theirs_.length() == 0 ? Move::C : theirs_.last(); }

  LastMoves<6, std::uint16_t> theirs_;
  Kind kind_ = Kind::unknown;
  std::uint8_t phase_ = 0;  // rounds up to 6, then 6 to 11 over and over
};

/// The one of 2006 knows exact words of six moves.
class AdaptivePavlov2006 : AdaptivePavlov {
public:
  Move move() const {
    if (first_six() || kind_ == Kind::cooperative) return tit_for_tat();
    switch (kind_) {
      case Kind::mistrustful: return since() < 2 ? Move::C : tit_for_tat();
      case Kind::pavlov: return since() == 0 ? Move::D : Move::C;
      default: return Move::D;
    }
  }
  void observe(Move, Move theirs) {
    if (!counts_six(theirs)) return;
    switch (theirs_.word()) {
      case 0b1'000000: kind_ = Kind::cooperative; break;
      case 0b1'111111: kind_ = Kind::defector; break;
      case 0b1'101010: kind_ = Kind::mistrustful; break;
      case 0b1'110110: kind_ = Kind::pavlov; break;
      default:
        if (kind_ == Kind::unknown) kind_ = Kind::random;
    }
  }
};

/// The one of 2011 counts their D.
class AdaptivePavlov2011 : AdaptivePavlov {
public:
  Move move() const {
    if (first_six() || kind_ == Kind::cooperative) return tit_for_tat();
    if (kind_ != Kind::mistrustful) return Move::D;
    return theirs_.last() == Move::D && theirs_.before(1) == Move::D ? Move::D : Move::C;
  }
  void observe(Move, Move theirs) {
    if (!counts_six(theirs)) return;
    const unsigned defections = theirs_.defections();
    if (defections == 0) {
      kind_ = Kind::cooperative;
    } else if (defections >= 4) {
      kind_ = Kind::defector;
    } else if (defections == 3) {
      kind_ = Kind::mistrustful;
    } else if (kind_ == Kind::unknown) {
      kind_ = Kind::random;
    }
  }
};

/// Prober 4: an opening of 20 moves; if their D after its D and after its C there differ by at most two, D for ever,
/// else C for five rounds and tit_for_tat.
class Prober4 {
public:
  Move move() const {
    constexpr std::array<char, 21> opening{"CCDCDDDCCDCDCCDCDDCD"};
    if (rounds_ < 20) return opening[rounds_] == 'C' ? Move::C : Move::D;
    if (std::abs(difference_) <= 2) return Move::D;
    return rounds_ < 25 ? Move::C : last_;
  }
  void observe(Move own, Move theirs) {
    // What they answer to the last move of the opening comes too late to be counted.
    if (rounds_ < 19 && theirs == Move::D)
      difference_ = static_cast<std::int8_t>(difference_ + (own == Move::D ? 1 : -1));
    if (rounds_ < 25) ++rounds_;
    last_ = theirs;
  }

private:
  std::uint8_t rounds_ = 0;
  std::int8_t difference_ = 0;  // their D after its D, less those after its C
  Move last_ = Move::C;
};

/// Double Crosser: back_stabber, but tf2t from round 8 to 180 with those who played C in the first seven rounds.
class DoubleCrosser {
public:
  Move move() const {
    if (rounds_ >= 7 && rounds_ < 180 && !early_defection_)
      return last_ == Move::D && before_ == Move::D ? Move::D : Move::C;
    return defections_ > 3 ? Move::D : Move::C;
  }
  void observe(Move, Move theirs) {
    if (theirs == Move::D) {
      if (rounds_ < 7) early_defection_ = true;
      if (defections_ < 4) ++defections_;
    }
    if (rounds_ < 180) ++rounds_;
    before_ = last_;
    last_ = theirs;
  }

private:
  std::uint8_t rounds_ = 0;
  std::uint8_t defections_ = 0;
  bool early_defection_ = false;
  Move last_ = Move::C;
  Move before_ = Move::C;
};

}  // namespace folk
