#include <folk/strategies/axelrod/balance_machine.h>

#include <algorithm>
#include <cstdlib>

namespace folk {

State BalanceMachine::pack(std::int64_t sum, unsigned rounds, Move last) {
  if (std::abs(sum) >= std::int64_t{1} << 58U) throw CounterOverflow("a balance has grown beyond 2^58");
  return (static_cast<State>(sum) << 5U) | (State{rounds} << 1U) | bit(last);
}

double BalanceMachine::cooperation(State state) const {
  if (rounds(state) < rule_.patience) return 1;
  const Answer answer = sum(state) < 0 ? rule_.negative : sum(state) > 0 ? rule_.positive : rule_.zero;
  if (answer == Answer::copy) return last(state) == Move::C ? 1 : 0;
  return answer == Answer::cooperate ? 1 : 0;
}

State BalanceMachine::next(State state, Move own, Move theirs) const {
  return pack(sum(state) + rule_.weights[Outcome{own, theirs}.index()], std::min(rounds(state) + 1, rule_.patience),
              theirs);
}

CounterView BalanceMachine::view(State state) const {
  Counter counter{.value = sum(state)};
  State sign = 0;
  if (counter.value < 0) {
    counter.high = -1;
    sign = 1;
  } else if (counter.value > 0) {
    counter.low = 1;
    sign = 2;
  } else {
    counter.low = counter.high = 0;
  }
  return {(sign << 5U) | (state & 31U), 1, {counter, {}}};
}

State BalanceMachine::state_of(const CounterView& view) const {
  return pack(view.counters[0].value, rounds(view.control), last(view.control));
}

}  // namespace folk
