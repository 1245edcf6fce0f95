#pragma once
// A strategy as a Moore machine on one 64-bit word: everything exact in Folk follows from this interface.

#include <folk/games/error.h>
#include <folk/games/move.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace folk {

/// All that a machine remembers of a match.
using State = std::uint64_t;

/// An integer that a machine keeps in its state, with the range in which the machine behaves the same whatever its
/// value.
struct Counter {
  std::int64_t value = 0;
  std::int64_t low = std::numeric_limits<std::int64_t>::min();
  std::int64_t high = std::numeric_limits<std::int64_t>::max();
};

/// A state as a finite control and up to two unbounded counters.
struct CounterView {
  State control = 0;
  std::size_t size = 0;
  std::array<Counter, 2> counters{};
};

/// A machine's counter outgrew its place in the state; thrown by Machine::next and Machine::state_of.
class CounterOverflow : public UsageError {
public:
  using UsageError::UsageError;
};

/// A Moore machine: the move depends on the state, the next state on both moves really played.
///
/// Infinite machines (majorities, gradual) say how their state splits into control and counters, so that a run of
/// rounds in which only counters drift can be skipped exactly. Their contract: what a round adds to each counter
/// depends on (control, own, theirs) alone unless the number of counters changes, and so does the next control as long
/// as the new values lie in the ranges that it comes with.
class Machine {
public:
  virtual ~Machine() = default;

  /// The state before the first round.
  virtual State start() const = 0;

  /// P(C | state), in [0, 1].
  virtual double cooperation(State state) const = 0;

  /// The state after a round in which `own` and `theirs` were really played (after any noise).
  virtual State next(State state, Move own, Move theirs) const = 0;

  /// False when some state mixes (0 < P(C) < 1).
  virtual bool deterministic() const { return true; }

  /// False when infinitely many states can be reached.
  virtual bool finite() const { return true; }

  /// The state as control and counters; a finite machine has none.
  virtual CounterView view(State state) const { return {state, 0, {}}; }

  /// The inverse of view: the state with this control and these counter values.
  virtual State state_of(const CounterView& view) const { return view.control; }

protected:
  Machine() = default;
  Machine(const Machine&) = default;
  Machine& operator=(const Machine&) = default;
};

/// The move of a deterministic machine in this state.
inline Move move_of(const Machine& machine, State state) {
  return machine.cooperation(state) > 0.5 ? Move::C : Move::D;
}

}  // namespace folk
