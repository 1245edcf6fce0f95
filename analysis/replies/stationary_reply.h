#pragma once
// The best reply without end: by policy iteration on the opponent's states (Howard 1960), exact against a
// deterministic machine.

#include <folk/analysis/replies/reply_problem.h>
#include <folk/games/criterion.h>

namespace folk {

/// The best reply under discounted, mean or ending.
///
/// Without chance the policy is improved until no exact gain is left (differences too small for doubles are settled in
/// rationals), so that `optimum` is the optimum. With chance it is solved in doubles and `residual` bounds the error:
/// max |TV - V| / (1 - continuation) for discounted and ending, T the optimality operator, rounding counted in; for
/// mean the largest improvement that policy iteration no longer took or that rounding hides.
/// Throws UsageError on sizes that cannot be solved, std::logic_error for finite.
StationaryReply stationary_reply(const ReplyProblem& problem, const Criterion& criterion);

}  // namespace folk
