#pragma once
// What the lazy walks say, by listing a class and playing the pairs one by one.

#include <folk/analysis/play/cycle_table.h>
#include <folk/analysis/play/pair_result.h>
#include <folk/games/match_rules.h>
#include <folk/strategies/automaton.h>
#include <folk/strategies/standard/memory_class.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace folk::test {

inline CycleTable cycle_table(const Machine& machine) {
  return CycleTable(*tabulate(machine, Sense::own_moves_its_own));
}

inline std::vector<CycleTable> listed(const MemoryClass& members) {
  std::vector<CycleTable> tables;
  for (std::uint64_t i = 0; i < std::uint64_t{1} << members.genes(); ++i)
    tables.push_back(cycle_table(members.member(i)));
  return tables;
}

/// A match's payoffs and the first player's cooperations, weighed by a criterion.
struct NaiveMatch {
  double own = 0;
  double theirs = 0;
  double cooperations = 0;

  bool wins() const { return own - theirs > 1e-12 * (std::abs(own) + std::abs(theirs)); }
  bool draws() const { return std::abs(own - theirs) <= 1e-12 * (std::abs(own) + std::abs(theirs)); }
};

inline NaiveMatch naive_match(CycleFinder& finder, const CycleTable& a, const CycleTable& b, const MatchRules& rules) {
  const auto weights = finder.play(a, b, rules.criterion).weights;
  const auto payoffs = rules.payoffs.numbers();
  return {weights[0] * payoffs[0] + weights[1] * payoffs[1] + weights[2] * payoffs[2] + weights[3] * payoffs[3],
          weights[0] * payoffs[0] + weights[2] * payoffs[1] + weights[1] * payoffs[2] + weights[3] * payoffs[3],
          weights[0] + weights[1]};
}

}  // namespace folk::test
