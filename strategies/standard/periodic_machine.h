#pragma once
// Strategies that repeat a word of moves for ever, whatever the other plays.

#include <folk/strategies/machine.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace folk {

/// The state is the place in the word.
class PeriodicMachine final : public Machine {
public:
  /// `word` holds C and D in either case. Throws UsageError when it is empty, holds another letter or is longer than
  /// 10,000 moves.
  explicit PeriodicMachine(std::string_view word);

  /// "per_ccd".
  std::string name() const;

  State start() const override { return 0; }
  double cooperation(State state) const override { return word_[state] ? 0 : 1; }
  State next(State state, Move, Move) const override { return (state + 1) % word_.size(); }

private:
  std::vector<bool> word_;  // true = D
};

}  // namespace folk
