#pragma once
// Fixed sequences without a period, and strategies that aim at a ratio of C to D.

#include <folk/strategies/axelrod/record.h>

#include <bit>
#include <cstdint>

namespace folk {

/// Anti Cycler: C, D, then D after one C, D after two C, and so on.
class AntiCycler {
public:
  Move move() const { return rounds_ == 0 || left_ > 0 ? Move::C : Move::D; }
  void observe(Move, Move) {
    if (++rounds_ < 3) return;
    if (left_ > 0) {
      --left_;
    } else {
      left_ = ++length_;
    }
  }

private:
  std::uint64_t rounds_ = 0;
  std::uint64_t length_ = 0;
  std::uint64_t left_ = 0;
};

/// The Thue-Morse sequence: the parity of the ones in the round's number, from 0.
template <Move at_even>
class ThueMorse {
public:
  Move move() const { return std::popcount(round_) % 2 == 0 ? at_even : other(at_even); }
  void observe(Move, Move) { ++round_; }

private:
  std::uint64_t round_ = 0;
};

/// D while both sides' C are more than `ratio` times both sides' D; C first, and D against who has never played D.
template <double (*ratio)()>
class CooperationRatio {
public:
  Move move() const {
    if (record_.rounds() == 0) return Move::C;
    if (record_.theirs.defections() == 0) return Move::D;
    const auto cooperations = static_cast<double>(record_.own.cooperations() + record_.theirs.cooperations());
    const auto defections = static_cast<double>(record_.own.defections() + record_.theirs.defections());
    return cooperations / defections > ratio() ? Move::D : Move::C;
  }
  void observe(Move own, Move theirs) { record_.add(own, theirs); }

private:
  Record record_;
};

}  // namespace folk
