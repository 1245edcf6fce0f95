#include <folk/games/outcome.h>
#include <folk/strategies/facts.h>

#include <algorithm>
#include <cstdint>
#include <unordered_set>
#include <utility>
#include <vector>

namespace folk {
namespace {

constexpr Sense own = Sense::own_moves_its_own;

/// Two different states of an automaton.
struct Pair {
  std::uint32_t s;
  std::uint32_t t;

  /// Its place among the n(n-1)/2 unordered pairs.
  std::size_t index() const {
    const std::size_t high = std::max(s, t);
    return high * (high - 1) / 2 + std::min(s, t);
  }
};

/// Calls `visit` with each pair of different states that an outcome possible in both states of `pair` leads to.
template <class Visit>
void for_each_successor(const Automaton& automaton, Pair pair, Visit&& visit) {
  const auto& a = automaton.nodes()[pair.s];
  const auto& b = automaton.nodes()[pair.t];
  for (const Outcome outcome : all_outcomes) {
    const std::size_t o = outcome.index();
    if (possible(a.cooperation, outcome, own) && possible(b.cooperation, outcome, own) && a.next[o] != b.next[o])
      visit(Pair{a.next[o], b.next[o]});
  }
}

std::vector<Pair> all_pairs(std::size_t states) {
  std::vector<Pair> pairs;
  pairs.reserve(states * (states - 1) / 2);
  for (std::uint32_t s = 1; s < states; ++s)
    for (std::uint32_t t = 0; t < s; ++t) pairs.push_back({s, t});
  return pairs;
}

/// True when always taking the first (or last) round that does not tell two states apart leads round a cycle: then no
/// number of rounds does.
bool runs_for_ever(const Automaton& automaton, Pair pair, bool take_last) {
  std::unordered_set<std::size_t> seen;
  while (seen.insert(pair.index()).second) {
    std::optional<Pair> next;
    for_each_successor(automaton, pair, [&](Pair to) {
      if (take_last || !next) next = to;
    });
    if (!next) return false;
    pair = *next;
  }
  return true;
}

/// What a few pairs show of an automaton that has too many.
Memory memory_by_samples(const Automaton& automaton) {
  constexpr std::uint32_t samples = 1000;
  for (std::uint32_t s = 1; s < std::min<std::size_t>(automaton.size(), samples); ++s)
    if (runs_for_ever(automaton, {s, s - 1}, false) || runs_for_ever(automaton, {s, s - 1}, true))
      return {Memory::Kind::unbounded, 0};
  return {};
}

}  // namespace

std::string to_string(const Memory& memory) {
  switch (memory.kind) {
    case Memory::Kind::rounds: return std::to_string(memory.rounds);
    case Memory::Kind::unbounded: return "unbounded";
    case Memory::Kind::unknown: break;
  }
  return "?";
}

Memory memory_of(const Automaton& minimised, std::size_t most_states) {
  if (minimised.size() == 1) return {Memory::Kind::rounds, 0};
  if (minimised.size() > most_states) return memory_by_samples(minimised);
  const std::vector<Pair> pairs = all_pairs(minimised.size());
  std::vector<std::uint32_t> arrivals(pairs.size());
  for (const Pair pair : pairs) for_each_successor(minimised, pair, [&](Pair to) { ++arrivals[to.index()]; });

  // Pairs in topological order; one that never gets ready lies on a cycle or behind one.
  std::vector<Pair> ready;
  for (const Pair pair : pairs)
    if (arrivals[pair.index()] == 0) ready.push_back(pair);
  std::vector<std::size_t> longest(pairs.size());
  std::size_t most = 0;
  for (std::size_t done = 0; done < ready.size(); ++done) {
    const std::size_t length = longest[ready[done].index()];
    most = std::max(most, length);
    for_each_successor(minimised, ready[done], [&](Pair to) {
      longest[to.index()] = std::max(longest[to.index()], length + 1);
      if (--arrivals[to.index()] == 0) ready.push_back(to);
    });
  }
  if (ready.size() < pairs.size()) return {Memory::Kind::unbounded, 0};
  return {Memory::Kind::rounds, most + 1};
}

Niceness niceness_of(const Machine& machine, std::size_t most_rounds) {
  std::unordered_set<State> seen;
  State state = machine.start();
  for (std::size_t round = 0; round < most_rounds; ++round) {
    if (machine.cooperation(state) < 1) return {false, std::nullopt};
    if (!seen.insert(state).second) return {true, std::nullopt};
    state = machine.next(state, Move::C, Move::C);
  }
  return {true, most_rounds};
}

Facts facts_of(const Machine& machine, std::size_t most_states) {
  Facts facts;
  facts.finite = machine.finite();
  facts.deterministic = machine.deterministic();
  facts.niceness = niceness_of(machine);
  if (!facts.finite) {
    facts.memory = {Memory::Kind::unbounded, 0};
    return facts;
  }
  if (const auto table = tabulate(machine, own, most_states)) {
    const Automaton smallest = minimise(*table, own);
    facts.states = smallest.size();
    facts.deterministic = smallest.deterministic();
    facts.memory = memory_of(smallest);
  }
  if (const auto table = tabulate(machine, Sense::any_own_moves, most_states))
    facts.states_any_own_moves = minimise(*table, Sense::any_own_moves).size();
  return facts;
}

}  // namespace folk
