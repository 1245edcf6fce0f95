#pragma once
// Grumpy: a mood that turns slowly.

#include <folk/strategies/machine.h>

namespace folk {

/// C until their D lead by more than ten, then D until their C lead by more than ten, and so on.
class GrumpyMachine final : public Machine {
public:
  State start() const override { return 0; }
  double cooperation(State state) const override { return grumpy(state) ? 0 : 1; }
  State next(State state, Move, Move theirs) const override {
    const std::int64_t after = lead(state) + (theirs == Move::D ? 1 : -1);
    return pack(after, grumpy(state) ? after >= -turning : after > turning);
  }
  bool finite() const override { return false; }

  CounterView view(State state) const override {
    Counter counter{.value = lead(state)};
    if (grumpy(state)) {
      counter.low = -turning;
    } else {
      counter.high = turning;
    }
    return {state & 1U, 1, {counter, {}}};
  }
  State state_of(const CounterView& view) const override { return pack(view.counters[0].value, view.control != 0); }

private:
  static constexpr std::int64_t turning = 10;

  // A state: the lead of their D (63 bits, signed), the mood (1 bit).
  static State pack(std::int64_t lead, bool grumpy) {
    return (static_cast<State>(lead) << 1U) | (grumpy ? State{1} : State{0});
  }
  static std::int64_t lead(State state) { return static_cast<std::int64_t>(state) >> 1U; }
  static bool grumpy(State state) { return (state & 1U) != 0; }
};

}  // namespace folk
