#pragma once
// The best reply without end: by policy iteration on the opponent's states (Howard 1960), exact against a
// deterministic machine.

#include <folk/analysis/replies/reply_problem.h>
#include <folk/games/criterion.h>
#include <folk/games/rational.h>

#include <optional>
#include <vector>

namespace folk {

/// A best move in every state of a reply problem, and what it is worth from there on.
struct StationaryReply {
  std::vector<Move> moves;            ///< by state; C where both are as good
  std::vector<double> values;         ///< by state, in the criterion's unit (mean: a round)
  double residual = 0;                ///< no reply earns more than values + residual anywhere
  std::optional<Rational> optimum;    ///< from the start on: exact, and proved to be the best; set without chance
  std::vector<Rational> exact_means;  ///< without chance and for mean: the best mean from each state on
};

/// The best reply under discounted, mean or ending.
///
/// Without chance the policy is improved until no exact gain is left (differences too small for doubles are settled in
/// rationals), so that `optimum` is the optimum. With chance it is solved in doubles and `residual` bounds the error:
/// max |TV - V| / (1 - continuation) for discounted and ending, T the optimality operator, rounding counted in; for
/// mean the largest improvement that policy iteration no longer took or that rounding hides.
/// Throws UsageError on sizes that cannot be solved, std::logic_error for finite.
StationaryReply stationary_reply(const ReplyProblem& problem, const Criterion& criterion);

}  // namespace folk
