#pragma once
// Self-confirming equilibrium (Fudenberg & Levine, Econometrica 61, 1993): beliefs agree with the opponent wherever
// play leads, and are free elsewhere. What can a side still gain, whatever it believes there?

#include <folk/analysis/equilibria/gap.h>
#include <folk/analysis/play/play_path.h>
#include <folk/analysis/replies/class_replies.h>
#include <folk/analysis/replies/path_payoffs.h>
#include <folk/games/criterion.h>
#include <folk/games/payoffs.h>
#include <folk/games/progress.h>
#include <folk/strategies/automaton.h>

#include <optional>

namespace folk {

// Where `paid` is given, it is what the path or the pair pays the side (PathPayoffs, expected_payoff): whoever asks
// several gaps of a pair finds it once.

/// To how little the opponent can hold a player of this game by mixing: what the worst belief expects off the path.
Rational mixed_minmax(const Payoffs& payoffs);

/// Unrestricted beliefs, over a path without chance (as the side sees it): the opponent plays as it truly does along
/// the path, and after any other history gives the side its mixed minmax v for ever. The gain from the start is
///   max(0, max over path rounds t and deviations a' of w_t [r(a', b_t) + v from then on - the path's payoff from t]),
/// w_t = 1 for finite, continuation^(t-1) for discounted and ending; v - the path's mean for mean. Exact.
Gap unrestricted_gap(const PlayPath& path, const Payoffs& payoffs, const Criterion& criterion);
Gap unrestricted_gap(const PlayPath& path, const PathPayoffs& paid, const Payoffs& payoffs);

/// The same where chance plays a part: a best reply when every own move that `own` never makes in its situation leads
/// to v for ever. Automata for finite:T are unrolled over T rounds.
Gap unrestricted_gap(const Automaton& own, const Automaton& theirs, const Payoffs& payoffs, const Criterion& criterion);
Gap unrestricted_gap(const Automaton& own, const Automaton& theirs, double paid, const Payoffs& payoffs,
                     const Criterion& criterion);

/// Beliefs of a class: the least gain of a best reply over the machines of `beliefs` that agree with the opponent on
/// the path (no mixtures of them; ties by roster order). The witness names that machine. Nothing when none agrees.
/// Infinite members count within the horizon of `beliefs` under discounted and ending; under mean they are
/// left out, and unless another member gives 0 the gap is then a bound (0) that says so. `progress` is told the share
/// of the members that have been seen.
std::optional<Gap> class_gap(const PlayPath& path, ClassReplies& beliefs, const Progress& progress = nullptr);
std::optional<Gap> class_gap(const PlayPath& path, const PathPayoffs& paid, ClassReplies& beliefs,
                             const Progress& progress = nullptr);

/// The same where chance plays a part: members agree when their P(C) is the opponent's after every history of positive
/// probability. Infinite members do not count under criteria without end.
std::optional<Gap> class_gap(const Automaton& own, const Automaton& theirs, ClassReplies& beliefs,
                             const Progress& progress = nullptr);
std::optional<Gap> class_gap(const Automaton& own, const Automaton& theirs, double paid, ClassReplies& beliefs,
                             const Progress& progress = nullptr);

/// Beliefs of a class under noise strictly between 0 and 1. Every history comes about, so that a member agrees only
/// when it answers as `theirs` does after all of them (of fewer than T rounds, for finite:T), and the best reply to it
/// is the best reply to `theirs`: the gap is `nash`, the Nash gap, with the first such member for its belief. Nothing
/// when none agrees; a bound (0) that says so when members that are too large to compare may.
std::optional<Gap> class_gap_under_noise(const Machine& theirs, const Gap& nash, const ClassReplies& beliefs,
                                         const Progress& progress = nullptr);

}  // namespace folk
