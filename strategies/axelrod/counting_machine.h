#pragma once
// Rules (rule.h) with one unbounded count, of which it only matters whether it has reached a threshold, as machines.

#include <folk/strategies/axelrod/rule.h>
#include <folk/strategies/machine.h>

#include <concepts>

namespace folk {

/// The rule itself is what it remembers besides the count, which is 0 before the first round.
template <class R>
concept CountingRule = std::copyable<R> && std::default_initializable<R> &&
    requires(R rule, const R& before, Move own, Move theirs, bool reached) {
  { before.move() } -> std::same_as<Move>;
  { before.adds(own, theirs) } -> std::same_as<std::int64_t>;  ///< to the count, by this round
  rule.observe(own, theirs, reached);                          ///< reached: whether the count now has R::threshold
  { R::threshold } -> std::convertible_to<std::int64_t>;
};

template <CountingRule R>
class CountingMachine final : public Machine {
  static_assert(sizeof(R) <= 3);

public:
  State start() const override { return pack(R{}, 0); }
  double cooperation(State state) const override { return value_of<R>(state).move() == Move::C ? 1 : 0; }

  State next(State state, Move own, Move theirs) const override {
    R rule = value_of<R>(state);
    const std::int64_t after = count(state) + rule.adds(own, theirs);
    rule.observe(own, theirs, after >= R::threshold);
    return pack(rule, after);
  }

  bool finite() const override { return false; }

  CounterView view(State state) const override {
    Counter counter{.value = count(state)};
    const bool reached = counter.value >= R::threshold;
    (reached ? counter.low : counter.high) = reached ? R::threshold : R::threshold - 1;
    return {(state & rule_mask) | (reached ? State{1} << 24U : 0), 1, {counter, {}}};
  }

  State state_of(const CounterView& view) const override {
    return pack(value_of<R>(view.control), view.counters[0].value);
  }

private:
  static constexpr State rule_mask = 0xFFFFFFU;

  // A state: the count (40 bits, signed), the rule (24 bits).
  static State pack(const R& rule, std::int64_t count) {
    constexpr auto most = std::int64_t{1} << 39U;
    if (count >= most || count < -most) throw CounterOverflow("a strategy has counted beyond 2^39");
    return bytes_of(rule) | (static_cast<State>(count) << 24U);
  }
  static std::int64_t count(State state) { return static_cast<std::int64_t>(state) >> 24U; }
};

}  // namespace folk
