#pragma once
// Strategies that weigh every round and look at the sign of the sum: majorities, retaliators, forgivers.

#include <folk/games/outcome.h>
#include <folk/strategies/machine.h>

#include <array>
#include <cstdint>

namespace folk {

/// A sum starts at 0 and grows by a weight for each outcome; the move depends on its sign.
class BalanceMachine final : public Machine {
public:
  enum class Answer { cooperate, defect, copy };  ///< copy: their last move, C in round 1

  struct Rule {
    std::array<int, 4> weights;  ///< by own and their move: CC, CD, DC, DD
    Answer negative;
    Answer zero;
    Answer positive;
    unsigned patience = 0;  ///< C in so many rounds first, at most 15
  };

  explicit BalanceMachine(Rule rule)
      : rule_(rule) {}

  State start() const override { return pack(0, 0, Move::C); }
  double cooperation(State state) const override;
  State next(State state, Move own, Move theirs) const override;
  bool finite() const override { return false; }
  CounterView view(State state) const override;
  State state_of(const CounterView& view) const override;

private:
  // A state: the sum (59 bits, signed), rounds played up to `patience` (4 bits), their last move (1 bit).
  static State pack(std::int64_t sum, unsigned rounds, Move last);
  static std::int64_t sum(State state) { return static_cast<std::int64_t>(state) >> 5U; }
  static unsigned rounds(State state) { return static_cast<unsigned>(state >> 1U) & 15U; }
  static Move last(State state) { return move_from_bit(static_cast<unsigned>(state & 1U)); }

  Rule rule_;
};

}  // namespace folk
