#include <folk/strategies/standard/gradual_machine.h>

namespace folk {

State GradualMachine::pack(Phase phase, std::int64_t defections, std::int64_t left) {
  if (defections > static_cast<std::int64_t>(most)) throw CounterOverflow("gradual has counted 2^31 defections");
  return (State{phase} << 62U) | (static_cast<State>(defections) << 31U) | static_cast<State>(left);
}

State GradualMachine::next(State state, Move, Move theirs) const {
  const Phase now = phase(state);
  const bool defected = theirs == Move::D;
  std::int64_t count = defections(state);
  if (defected && (counts_ == Counts::every_defection || now == watch)) ++count;
  switch (now) {
    case watch:
      if (!defected) return pack(watch, count, 0);
      return count == 1 ? pack(last, count, 0) : pack(punish, count, count);
    case punish: return left(state) == 2 ? pack(last, count, 0) : pack(punish, count, left(state) - 1);
    case last: return pack(calm, count, 0);
    case calm: break;
  }
  // One calming round is over. The second one is no other than watching, unless a D in it is to be ignored: then
  // `left` marks it.
  if (calm_ == Calm::ignores_both_rounds && left(state) == 0) return pack(calm, count, 1);
  return pack(watch, count, 0);
}

CounterView GradualMachine::view(State state) const {
  constexpr auto limit = static_cast<std::int64_t>(most);
  const std::int64_t count = defections(state);
  if (phase(state) == punish)
    return {State{punish} << 62U, 2, {Counter{count, 0, limit}, Counter{left(state), 2, limit}}};
  // The first provocation is answered at once by the last D of a punishment, later ones are not: before it the machine
  // is under another control.
  const State unprovoked = count == 0 ? State{1} << 31U : 0;
  const Counter counted{count, count == 0 ? 0 : 1, count == 0 ? 0 : limit};
  return {(State{phase(state)} << 62U) | unprovoked | static_cast<State>(left(state)), 1, {counted, {}}};
}

State GradualMachine::state_of(const CounterView& view) const {
  const auto at = static_cast<Phase>(view.control >> 62U);
  return pack(at, view.counters[0].value,
              at == punish ? view.counters[1].value : static_cast<std::int64_t>(view.control & most));
}

}  // namespace folk
