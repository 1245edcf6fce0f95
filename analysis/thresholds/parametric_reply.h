#pragma once
// Best replies to a deterministic machine as the discount factor varies: an optimal reply and where it stays optimal.

#include <folk/analysis/thresholds/discount_set.h>
#include <folk/analysis/thresholds/plan_payoffs.h>
#include <folk/games/outcome.h>
#include <folk/strategies/automaton.h>

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace folk {

/// The decisions of a player whose opponent is a deterministic machine: one of two moves in each of its states.
class ReplyDecisions {
public:
  /// `opponent` as it plays (Sense::own_moves_its_own); `payoffs` to the player by outcome, own move first.
  ReplyDecisions(const Automaton& opponent, const std::array<Integer, 4>& payoffs);

  std::size_t size() const { return choices_.size(); }
  const Integer& payoff(std::uint32_t state, Move own) const {
    return payoffs_[choices_[state][bit(own)].outcome.index()];
  }
  std::uint32_t next(std::uint32_t state, Move own) const { return choices_[state][bit(own)].next; }

  /// What a reply earns that plays moves[s] in the opponent's state s.
  PlanPayoffs plan(const std::vector<Move>& moves) const;

private:
  struct Choice {
    Outcome outcome;
    std::uint32_t next = 0;
  };

  std::array<Integer, 4> payoffs_;
  std::vector<std::array<Choice, 2>> choices_;
};

/// A reply that is optimal from every state of the opponent on for all d of one closed interval.
struct ParametricReply {
  std::vector<Move> moves;         ///< by the opponent's state
  DiscountSet::Interval interval;  ///< around the d that was asked for; may be that point alone
};

/// An optimal reply at `d`, 0 < d < 1, and the largest interval around d where it stays optimal: policy iteration in
/// doubles, then exact, with the signs of the polynomials by which no change of one move pays (Howard 1960).
/// Nothing when a polynomial would have more than `most_terms` terms.
std::optional<ParametricReply> parametric_reply(const ReplyDecisions& decisions, const Rational& d,
                                                std::size_t most_terms);

}  // namespace folk
