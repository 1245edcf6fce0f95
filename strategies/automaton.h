#pragma once
// A finite machine as a dense table, and how any machine becomes one.

#include <folk/games/outcome.h>
#include <folk/strategies/machine.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace folk {

/// Over which histories two machines are compared, minimised or drawn.
enum class Sense {
  own_moves_its_own,  ///< own moves are the machine's own: the sense of play without noise
  any_own_moves  ///< own moves may differ from the machine's (noise, deviations): also needed for subgame perfection
};

/// A finite Moore machine: P(C) and four successors a state, by outcome index (CC, CD, DC, DD; own move first).
class Automaton final : public Machine {
public:
  struct Node {
    double cooperation = 1;
    std::array<std::uint32_t, 4> next{};

    bool operator==(const Node&) const = default;
  };

  /// Throws UsageError when there is no state, a successor does not exist, a probability is outside [0, 1], or there
  /// are names but not one a state.
  Automaton(std::vector<Node> nodes, std::uint32_t start, std::optional<std::uint32_t> beyond = std::nullopt,
            std::vector<std::string> state_names = {});

  State start() const override { return start_; }
  double cooperation(State state) const override { return nodes_[state].cooperation; }
  State next(State state, Move own, Move theirs) const override {
    return nodes_[state].next[Outcome{own, theirs}.index()];
  }
  bool deterministic() const override { return deterministic_; }

  const std::vector<Node>& nodes() const { return nodes_; }
  std::size_t size() const { return nodes_.size(); }

  /// The state that stands for everything past the horizon of `unroll`, if there is one; it has no meaning as play.
  std::optional<std::uint32_t> beyond() const { return beyond_; }

  /// What the states' author calls them, one a state; empty where nobody named them. They have no meaning as play.
  const std::vector<std::string>& state_names() const { return state_names_; }

  /// Equal as play: names do not count.
  bool operator==(const Automaton& other) const {
    return start_ == other.start_ && nodes_ == other.nodes_ && beyond_ == other.beyond_;
  }

private:
  std::vector<Node> nodes_;
  std::uint32_t start_;
  std::optional<std::uint32_t> beyond_;
  std::vector<std::string> state_names_;
  bool deterministic_ = true;
};

/// True when an outcome can follow a state with this P(C) in this sense.
inline bool possible(double cooperation, Outcome outcome, Sense sense) {
  return sense == Sense::any_own_moves || (outcome.own == Move::C ? cooperation > 0 : cooperation < 1);
}

/// The reachable states of a machine in breadth-first order (start first), or nothing when there are more than
/// `most_states`. In the sense own_moves_its_own, successors under a move the state never plays repeat those under the
/// move it plays.
std::optional<Automaton> tabulate(const Machine& machine, Sense sense, std::size_t most_states = 1U << 20U);

/// The states a machine can reach in fewer than `horizon` rounds; all later ones are the one state `beyond()`
/// (absent when the machine closes sooner).
/// Throws UsageError when there are more than `most_states`.
Automaton unroll(const Machine& machine, Sense sense, unsigned horizon, std::size_t most_states = 1U << 20U);

/// The smallest automaton that answers alike in this sense, states in breadth-first order, so that two automata behave
/// alike if and only if their minimised forms are equal.
Automaton minimise(const Automaton& automaton, Sense sense);

/// For each state of `shown`, which plays as `machine` does in this sense (minimised, unrolled, or both), the names
/// that the machine's author gave to the states behind it, in breadth-first order; all empty for a machine without
/// names.
std::vector<std::vector<std::string>> names_behind(const Automaton& shown, const Machine& machine, Sense sense);

}  // namespace folk
