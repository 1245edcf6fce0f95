#pragma once
// mem2: tit_for_tat, tf2t or all_d, chosen anew every two rounds (Li & Kendall 2014), and the SCT paper's program of
// it.

#include <folk/strategies/machine.h>

namespace folk {

/// Starts as tit_for_tat. After two rounds: {CC, CC} -> tit_for_tat, {CD, DC} -> tf2t, else all_d;
/// the second time that all_d is chosen it stays for ever.
class Mem2Machine final : public Machine {
public:
  enum class Memory {
    rounds,       ///< looks at the last two rounds after rounds 2, 4, 6, ...
    stored_twice  ///< the program published with arXiv 2310.04579: chooses by payoff sums at 5, 3, 1, 0; from round 3
                  ///< on it stores each round twice, and so chooses after each, by that round twice
  };

  explicit Mem2Machine(Memory memory)
      : memory_(memory) {}

  State start() const override;
  double cooperation(State state) const override;
  State next(State state, Move own, Move theirs) const override;

private:
  Memory memory_;
};

}  // namespace folk
