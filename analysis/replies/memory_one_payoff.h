#pragma once
// What a memory-one strategy earns against a population of known machines.

#include <folk/games/match_rules.h>
#include <folk/games/move.h>
#include <folk/strategies/automaton.h>

#include <array>
#include <cstddef>
#include <vector>

namespace folk {

/// A memory-one strategy whose first move is pure. A mixed one is never needed: what is earned is linear in its
/// probability.
struct MemoryOne {
  Move opening = Move::C;
  std::array<double, 4> after{};  ///< P(C) by the last round's outcome (CC, CD, DC, DD; own move first)

  Automaton machine() const;
};

/// A machine and how often it is met.
struct WeightedOpponent {
  Automaton machine;
  double weight = 1;
};

/// Known opponents, one of which is met in each match.
class WeightedOpponents {
public:
  /// Weights are scaled to add up to 1. Machines without end come as tables that are right as long as the criterion
  /// lasts (table_for of analysis/play/criterion_table.h), with noise in the sense any_own_moves.
  /// Throws UsageError when nobody is in it, a weight is not positive or a machine is too
  /// large for its Markov chain to be solved many times.
  WeightedOpponents(std::vector<WeightedOpponent> members, const MatchRules& rules);

  std::size_t size() const { return members_.size(); }
  const WeightedOpponent& member(std::size_t i) const { return members_[i]; }
  const MatchRules& rules() const { return rules_; }

  /// What the strategy earns against one member, in the criterion's unit: from the pair's Markov chain, exact up to
  /// rounding. For mean this is the mean of the play that begins with the opening, also where the chain is not ergodic.
  double payoff(const MemoryOne& strategy, std::size_t member) const;

  /// The mean over the members by weight.
  double payoff(const MemoryOne& strategy) const;

private:
  double payoff(const Automaton& strategy, std::size_t member) const;

  std::vector<WeightedOpponent> members_;
  MatchRules rules_;
  std::array<double, 4> numbers_;  // the payoffs
};

}  // namespace folk
