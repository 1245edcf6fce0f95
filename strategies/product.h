#pragma once
// Two automata that play each other, as one automaton over pairs of states.

#include <folk/games/outcome.h>
#include <folk/strategies/automaton.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace folk {

/// A joint state: the number of each player's state, and the joint state after each outcome (the first player's move
/// first). Outcomes that cannot occur lead to 0, the start.
struct JointNode {
  std::uint32_t first = 0;
  std::uint32_t second = 0;
  std::array<std::uint32_t, 4> next{};
};

/// True when an outcome, as the first player sees it, can occur between states that cooperate with these probabilities.
inline bool possible_between(double first, double second, Outcome outcome, Sense sense) {
  return possible(first, outcome, sense) && possible(second, outcome.exchanged(), sense);
}

/// The joint states that play reaches, in breadth-first order, start first; nothing when there are more than
/// `most_states`. Sense::any_own_moves follows every outcome, as noise or deviations of both sides may produce it.
std::optional<std::vector<JointNode>> product(const Automaton& first, const Automaton& second, Sense sense,
                                              std::size_t most_states = 1U << 20U);

}  // namespace folk
