#pragma once
// Two automata and every joint state that some history reaches, also by deviations of either or both.

#include <folk/games/outcome.h>
#include <folk/strategies/product.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace folk {

/// The joint states, breadth first, start first, and the shortest history to each.
class JointPlay {
public:
  /// `first` and `second` must outlive this. Throws UsageError on more than `most_states` joint states.
  JointPlay(const Automaton& first, const Automaton& second, Sense sense, std::size_t most_states = 1U << 20U);

  std::size_t size() const { return nodes_.size(); }
  const JointNode& node(std::size_t state) const { return nodes_[state]; }

  /// P(C) of each machine in a joint state.
  double first_cooperation(std::size_t state) const { return first_.nodes()[nodes_[state].first].cooperation; }
  double second_cooperation(std::size_t state) const { return second_.nodes()[nodes_[state].second].cooperation; }

  /// Of deterministic machines: the outcome that both play in a joint state (the first machine's move first).
  Outcome outcome_in(std::size_t state) const;

  /// A shortest history that leads to a joint state, as the first machine sees it.
  std::vector<Outcome> history_to(std::size_t state) const;

  const Automaton& first() const { return first_; }
  const Automaton& second() const { return second_; }

private:
  const Automaton& first_;
  const Automaton& second_;
  std::vector<JointNode> nodes_;
  Sense sense_;
};

}  // namespace folk
