#pragma once
// What the best reply gains over what is played: 0 for both sides in a Nash equilibrium (Nash 1951).

#include <folk/analysis/equilibria/gap.h>
#include <folk/analysis/replies/best_reply.h>
#include <folk/analysis/replies/path_payoffs.h>
#include <folk/games/criterion.h>
#include <folk/games/match_rules.h>
#include <folk/games/payoffs.h>
#include <folk/strategies/machine.h>

namespace folk {

/// The gain, seen from the start, of the best reply to `theirs` over `path` (as the replying side sees it), which was
/// really played against it. The witness: where the best reply first leaves the path.
Gap nash_gap(const PlayPath& path, const Machine& theirs, const Payoffs& payoffs, const Criterion& criterion,
             unsigned horizon = 0);

/// The same where chance plays a part: over what `own` earns on average. Under noise the best reply's moves slip too,
/// and both automata must be tabulated in the sense any_own_moves.
Gap nash_gap(const Automaton& own, const Automaton& theirs, const MatchRules& rules);

/// The gain over the path of a best reply to some machine that plays along with it. `paid`: what the path pays.
Gap reply_gap(const PlayPath& path, const PathPayoffs& paid, const BestReply& reply);

/// The gain of a best reply over what is `paid` on average, in the criterion's unit; `rounding` is that of `paid`.
Gap reply_gap(double paid, double rounding, const BestReply& reply);

/// What a pair earns its first machine on average, in the criterion's unit. Throws UsageError when the pair is too
/// large to solve.
double expected_payoff(const Automaton& own, const Automaton& theirs, const MatchRules& rules);

}  // namespace folk
