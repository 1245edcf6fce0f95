#pragma once
// What can be computed of a machine alone: size, memory, niceness.

#include <folk/strategies/automaton.h>
#include <folk/strategies/machine.h>

#include <cstddef>
#include <optional>
#include <string>

namespace folk {

/// The smallest number of last rounds (both moves) that determine the state of a machine.
struct Memory {
  enum class Kind {
    rounds,     ///< `rounds` of them do
    unbounded,  ///< no number does: something from the past may matter for ever
    unknown     ///< the machine is too large for the computation
  };
  Kind kind = Kind::unknown;
  std::size_t rounds = 0;

  bool operator==(const Memory&) const = default;
};

/// "2", "unbounded" or "?".
std::string to_string(const Memory& memory);

/// The memory of a minimised automaton, its own moves being its own: two different states must be told apart by the
/// rounds that can follow both. One state needs 0 rounds; else one more than the longest run of rounds that leads two
/// different states to two different states; unbounded when such runs do not end. Above `most_states` only some such
/// runs are followed: the answer is then unbounded or unknown.
Memory memory_of(const Automaton& minimised, std::size_t most_states = 4096);

/// Never the first to defect: P(C) = 1 as long as both sides have only played C.
struct Niceness {
  bool nice = false;
  /// Nothing where the answer is proved; else the number of rounds that were tried.
  std::optional<std::size_t> rounds_tried;
};

/// Plays the machine against C and its own C until it repeats a state or `most_rounds` have passed.
Niceness niceness_of(const Machine& machine, std::size_t most_rounds = 10'000);

/// States of a larger machine are not counted.
inline constexpr std::size_t most_counted_states = 100'000;

/// All of the above.
struct Facts {
  bool finite = true;
  bool deterministic = true;  ///< no state that play reaches mixes
  /// States after minimisation; nothing for an infinite machine and for one with more than `most_states`.
  std::optional<std::size_t> states;                ///< own moves being its own
  std::optional<std::size_t> states_any_own_moves;  ///< any own moves
  Memory memory;                                    ///< an infinite machine's is taken to be unbounded
  Niceness niceness;
};

Facts facts_of(const Machine& machine, std::size_t most_states = most_counted_states);

}  // namespace folk
