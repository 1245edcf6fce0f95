#pragma once
// The best reply without end to a machine that mixes or slips, in doubles.

#include <folk/analysis/replies/reply_problem.h>
#include <folk/games/criterion.h>

namespace folk {

/// stationary_reply for any problem, exact or not: policy iteration, each policy evaluated as a Markov chain.
StationaryReply markov_reply(const ReplyProblem& problem, const Criterion& criterion);

}  // namespace folk
