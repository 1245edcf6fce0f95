#pragma once
// How one strategy does against a complete class, without listing it.

#include <folk/analysis/classes/class_score_settings.h>
#include <folk/analysis/crew/crew.h>
#include <folk/games/integer.h>
#include <folk/games/progress.h>
#include <folk/games/rational.h>
#include <folk/strategies/machine.h>
#include <folk/strategies/standard/memory_class.h>

#include <cstdint>
#include <optional>
#include <string>

namespace folk {

/// A member of the class that stands out.
struct StandingOut {
  double mean = 0;     ///< what the entrant earns against it, a round
  std::string member;  ///< genotype; of several the first in the order of the class
};

/// A strategy against all members of a class, each weighing alike.
struct ClassScore {
  double mean = 0;              ///< payoff a round
  double cooperation_rate = 0;  ///< its share of C
  /// The same without rounding, for finite:T and mean.
  std::optional<Rational> exact_mean;
  std::optional<Rational> exact_cooperation_rate;
  Integer beats;  ///< members that score less in their match than it does
  Integer draws;
  Integer loses;
  StandingOut best;   ///< the member against which it earns most
  StandingOut worst;  ///< and least
  std::uint64_t leaves = 0;
};

/// Scores a deterministic machine. The opponents' genes are revealed one by one as play asks for them: where play
/// returns to a joint state, or finite:T is over, the rest is known and what was asked stands for all members that have
/// it. Throws UsageError for a machine that mixes, for an infinite one unless finite:T bounds the match, for scores too
/// large to add up exactly; TooManyKinds when there are more leaves than settings allow; Cancelled; and what the crew
/// that shares the work throws.
ClassScore score_against(const MemoryClass& members, const Machine& entrant, const ClassScoreSettings& settings,
                         const Progress& progress = nullptr, const Crew& crew = one_process());

}  // namespace folk
