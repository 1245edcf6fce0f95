#pragma once
// The best reply to a machine under any criterion: what it earns, and the reply itself as a machine.

#include <folk/games/match_rules.h>
#include <folk/games/rational.h>
#include <folk/strategies/automaton.h>

#include <optional>

namespace folk {

/// A best reply to a known machine.
struct BestReply {
  double payoff = 0;              ///< what it earns, in the criterion's unit
  std::optional<Rational> exact;  ///< the same exactly: to a deterministic machine, without noise
  double residual = 0;            ///< no reply earns more than payoff + residual (0 where it is exact)
  /// The payoff is only a lower bound: rounds beyond this horizon were taken to pay the least payoff of the game.
  std::optional<unsigned> horizon{};
  Automaton machine;  ///< plays the reply; knows the opponent's state from what was really played
};

/// Dynamic programming over (state, rounds left) for finite:T, policy iteration on the machine's states else.
/// `horizon`: for machines without end under criteria without end, rounds that are unrolled.
/// Throws UsageError when the machine is infinite, the criterion has no end and no horizon is given (for mean: always),
/// and on sizes that cannot be solved.
BestReply best_reply(const Machine& opponent, const MatchRules& rules, unsigned horizon = 0);

/// The same for a machine that is the table of this criterion already: table_for(machine, criterion, sense, horizon),
/// in the sense any_own_moves where there is noise.
BestReply best_reply_to_table(const Automaton& opponent, const MatchRules& rules, unsigned horizon = 0);

}  // namespace folk
