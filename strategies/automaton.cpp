#include <folk/games/error.h>
#include <folk/strategies/automaton.h>

#include <algorithm>
#include <set>
#include <string>
#include <tuple>
#include <utility>

namespace folk {
namespace {

/// Numbers states in the order of their first mention: open addressing, because this runs once a genotype of a family.
class StateNumbers {
public:
  StateNumbers()
      : slots_(64, empty) {}

  /// The number of `state`; a new one gets the next number.
  std::uint32_t of(State state) {
    if (2 * (states_.size() + 1) > slots_.size()) grow();
    std::size_t slot = place(state);
    if (slots_[slot] == empty) {
      slots_[slot] = static_cast<std::uint32_t>(states_.size());
      states_.push_back(state);
    }
    return slots_[slot];
  }

  const std::vector<State>& states() const { return states_; }

private:
  static constexpr std::uint32_t empty = 0xFFFFFFFFU;

  std::size_t place(State state) const {
    std::uint64_t mixed = state * 0x9E3779B97F4A7C15U;
    mixed ^= mixed >> 29U;
    std::size_t slot = mixed & (slots_.size() - 1);
    while (slots_[slot] != empty && states_[slots_[slot]] != state) slot = (slot + 1) & (slots_.size() - 1);
    return slot;
  }

  void grow() {
    slots_.assign(slots_.size() * 2, empty);
    for (std::size_t i = 0; i < states_.size(); ++i) slots_[place(states_[i])] = static_cast<std::uint32_t>(i);
  }

  std::vector<std::uint32_t> slots_;
  std::vector<State> states_;
};

/// Successors of a node whose own move cannot occur repeat those of the move it plays.
void fill_impossible(Automaton::Node& node, Sense sense) {
  for (const Outcome outcome : all_outcomes)
    if (!possible(node.cooperation, outcome, sense)) node.next[outcome.index()] = node.next[outcome.deviated().index()];
}

/// The part of a machine that was reached: states[i] is the machine's own word for nodes[i].
struct Exploration {
  std::vector<Automaton::Node> nodes;
  std::vector<State> states;
  bool too_many = false;  ///< stopped at the limit
};

constexpr unsigned no_horizon = ~0U;

/// Visits the states reached in fewer than `horizon` rounds, start first, in breadth-first order. Successors may be
/// numbered nodes.size() and above: those lie beyond the horizon.
Exploration explore(const Machine& machine, Sense sense, std::size_t most_states, unsigned horizon = no_horizon) {
  StateNumbers numbers;
  numbers.of(machine.start());
  Exploration found;
  unsigned depth = 0;
  std::size_t depth_end = 1;  // states before this one are reached in `depth` rounds
  for (std::size_t i = 0; i < numbers.states().size(); ++i) {
    if (i == depth_end) {
      ++depth;
      depth_end = numbers.states().size();
    }
    if (depth >= horizon) break;
    if (numbers.states().size() > most_states) {
      found.too_many = true;
      break;
    }
    const State state = numbers.states()[i];
    Automaton::Node node{machine.cooperation(state), {}};
    for (const Outcome outcome : all_outcomes)
      if (possible(node.cooperation, outcome, sense))
        node.next[outcome.index()] = numbers.of(machine.next(state, outcome.own, outcome.theirs));
    fill_impossible(node, sense);
    found.nodes.push_back(node);
  }
  found.states = numbers.states();
  return found;
}

/// A state's class and those of its successors.
using Signature = std::array<std::uint32_t, 5>;

/// Numbers the distinct keys of all states; returns how many there are.
template <class Key>
std::uint32_t classify(const std::vector<Key>& keys, std::vector<std::uint32_t>& order,
                       std::vector<std::uint32_t>& classes) {
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return keys[a] < keys[b]; });
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i > 0 && keys[order[i - 1]] < keys[order[i]]) ++count;
    classes[order[i]] = count;
  }
  return count + 1;
}

}  // namespace

Automaton::Automaton(std::vector<Node> nodes, std::uint32_t start, std::optional<std::uint32_t> beyond,
                     std::vector<std::string> state_names)
    : nodes_(std::move(nodes)),
      start_(start),
      beyond_(beyond),
      state_names_(std::move(state_names)) {
  if (nodes_.empty()) throw UsageError("an automaton needs at least one state");
  if (!state_names_.empty() && state_names_.size() != nodes_.size())
    throw UsageError("an automaton of " + std::to_string(nodes_.size()) + " states has " +
                     std::to_string(state_names_.size()) + " names of states");
  if (start_ >= nodes_.size() || (beyond_ && *beyond_ >= nodes_.size()))
    throw UsageError("an automaton of " + std::to_string(nodes_.size()) + " states starts outside them");
  for (const Node& node : nodes_) {
    if (!(node.cooperation >= 0 && node.cooperation <= 1))
      throw UsageError("a state of an automaton cooperates with a probability outside [0, 1]");
    for (const std::uint32_t successor : node.next)
      if (successor >= nodes_.size())
        throw UsageError("a state of an automaton leads to state " + std::to_string(successor) + " of " +
                         std::to_string(nodes_.size()));
    if (node.cooperation > 0 && node.cooperation < 1) deterministic_ = false;
  }
}

std::optional<Automaton> tabulate(const Machine& machine, Sense sense, std::size_t most_states) {
  Exploration found = explore(machine, sense, most_states);
  if (found.too_many) return std::nullopt;
  return Automaton(std::move(found.nodes), 0);
}

Automaton unroll(const Machine& machine, Sense sense, unsigned horizon, std::size_t most_states) {
  if (horizon == 0) throw UsageError("a horizon of 0 rounds leaves nothing of a machine: give 1 or more");
  Exploration found = explore(machine, sense, most_states, horizon);
  if (found.too_many)
    throw UsageError("more than " + std::to_string(most_states) + " states within " + std::to_string(horizon) +
                     " rounds: play fewer of them");
  if (found.nodes.size() == found.states.size()) return Automaton(std::move(found.nodes), 0);
  const auto beyond = static_cast<std::uint32_t>(found.nodes.size());
  for (auto& node : found.nodes)
    for (auto& successor : node.next) successor = std::min(successor, beyond);
  found.nodes.push_back({1.0, {beyond, beyond, beyond, beyond}});
  return Automaton(std::move(found.nodes), 0, beyond);
}

Automaton minimise(const Automaton& automaton, Sense sense) {
  // Moore's partition refinement: states that answer alike are split as long as their successors differ.
  const auto& nodes = automaton.nodes();
  const std::size_t n = nodes.size();
  std::vector<std::uint32_t> order(n);
  for (std::size_t i = 0; i < n; ++i) order[i] = static_cast<std::uint32_t>(i);
  std::vector<std::uint32_t> classes(n);
  std::vector<std::pair<bool, double>> answers(n);
  for (std::size_t i = 0; i < n; ++i) answers[i] = {automaton.beyond() == i, nodes[i].cooperation};
  std::uint32_t count = classify(answers, order, classes);
  std::vector<Signature> signatures(n);
  for (std::uint32_t before = 0; before != count;) {
    before = count;
    for (std::size_t i = 0; i < n; ++i) {
      Automaton::Node node = nodes[i];
      fill_impossible(node, sense);
      signatures[i] = {classes[i], classes[node.next[0]], classes[node.next[1]], classes[node.next[2]],
                       classes[node.next[3]]};
    }
    count = classify(signatures, order, classes);
  }
  std::vector<Automaton::Node> quotient(count);
  for (std::size_t i = 0; i < n; ++i) {
    Automaton::Node node = nodes[i];
    fill_impossible(node, sense);
    for (auto& successor : node.next) successor = classes[successor];
    quotient[classes[i]] = node;
  }
  Exploration found = explore(Automaton(std::move(quotient), classes[automaton.start()]), sense, count);
  if (!automaton.beyond()) return Automaton(std::move(found.nodes), 0);
  const State past_horizon = classes[*automaton.beyond()];
  const auto place = std::find(found.states.begin(), found.states.end(), past_horizon);
  // In a narrower sense than the unrolling's nothing may lead past the horizon.
  if (place == found.states.end()) return Automaton(std::move(found.nodes), 0);
  return Automaton(std::move(found.nodes), 0, static_cast<std::uint32_t>(place - found.states.begin()));
}

std::vector<std::vector<std::string>> names_behind(const Automaton& shown, const Machine& machine, Sense sense) {
  std::vector<std::vector<std::string>> names(shown.size());
  const auto* automaton = dynamic_cast<const Automaton*>(&machine);
  if (automaton == nullptr || automaton->state_names().empty()) return names;
  // Both play side by side: whoever is met together is the same.
  using Pair = std::pair<std::uint32_t, std::uint32_t>;
  std::vector<Pair> open{{static_cast<std::uint32_t>(automaton->start()), static_cast<std::uint32_t>(shown.start())}};
  std::set<Pair> met{open.front()};
  for (std::size_t i = 0; i < open.size(); ++i) {
    const auto [state, drawn] = open[i];
    if (shown.beyond() == drawn) continue;
    names[drawn].push_back(automaton->state_names()[state]);
    for (const Outcome outcome : all_outcomes) {
      if (!possible(automaton->nodes()[state].cooperation, outcome, sense)) continue;
      const Pair next{automaton->nodes()[state].next[outcome.index()], shown.nodes()[drawn].next[outcome.index()]};
      if (met.insert(next).second) open.push_back(next);
    }
  }
  return names;
}

}  // namespace folk
