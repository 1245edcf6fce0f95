#pragma once
// soft_majo and hard_majo: do what the opponent has done more often.

#include <folk/strategies/machine.h>

#include <bit>

namespace folk {

/// The state is the number of their C less that of their D, so far.
class MajorityMachine final : public Machine {
public:
  enum class Tie { cooperate, defect };

  /// soft_majo cooperates when they are equal, hard_majo defects.
  explicit MajorityMachine(Tie tie)
      : least_(tie == Tie::cooperate ? 0 : 1) {}

  State start() const override { return 0; }
  double cooperation(State state) const override { return lead(state) >= least_ ? 1 : 0; }
  State next(State state, Move, Move theirs) const override { return theirs == Move::C ? state + 1 : state - 1; }
  bool finite() const override { return false; }

  CounterView view(State state) const override {
    Counter counter{.value = lead(state)};
    const bool cooperates = counter.value >= least_;
    (cooperates ? counter.low : counter.high) = cooperates ? least_ : least_ - 1;
    return {cooperates ? State{0} : State{1}, 1, {counter, {}}};
  }
  State state_of(const CounterView& view) const override { return std::bit_cast<State>(view.counters[0].value); }

private:
  static std::int64_t lead(State state) { return std::bit_cast<std::int64_t>(state); }

  std::int64_t least_;  // the smallest lead of their C at which it cooperates
};

}  // namespace folk
