#pragma once
// The largest gain from one deviation after any history: 0 in a subgame-perfect equilibrium (Selten 1965).

#include <folk/analysis/equilibria/gap.h>
#include <folk/games/match_rules.h>
#include <folk/strategies/automaton.h>

#include <cstddef>

namespace folk {

/// The gaps of the two sides of a pair.
struct BothGaps {
  Gap first;
  Gap second;
};

/// For finite, discounted and ending: the largest gain of either side from deviating once, over the joint states (with
/// the rounds left, for finite) that some history reaches, by deviations of either side or both at once, seen from
/// there: by the one-shot deviation principle (Mailath & Samuelson 2006, proposition 2.2.1) it is 0 exactly in
/// subgame-perfect equilibria. For mean, where that principle fails, the largest gain of a best reply over those
/// states. Under noise a deviation is to mean the other move, and slips as moves do; a history is what was really
/// played (perfect public equilibrium, Fudenberg, Levine & Maskin 1994). Exact for deterministic machines without
/// noise; under noise, but for mean, exactly 0 where each move of the machine is the better one by more than all
/// rounding. Both automata must be tabulated in the sense any_own_moves (for finite:T: unrolled over T rounds). Throws
/// UsageError on more than `most_joint_states`, and where the joint chain cannot be solved.
BothGaps subgame_perfect_gaps(const Automaton& first, const Automaton& second, const MatchRules& rules,
                              std::size_t most_joint_states = 1U << 20U);

}  // namespace folk
