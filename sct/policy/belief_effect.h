#pragma once
// Does the belief matter? The belief is forced to each move, and the moves that change are counted.

#include <folk/games/progress.h>
#include <folk/sct/policy/thinker.h>
#include <folk/strategies/strategy.h>

#include <cstdint>
#include <vector>

namespace folk::sct {

/// Of a policy's own play against a roster, round by round, its history staying what it was.
struct BeliefEffect {
  std::uint64_t rounds = 0;
  std::uint64_t changed_by_c = 0;  ///< own moves that are others once the belief says C
  std::uint64_t changed_by_d = 0;  ///< likewise D
  std::uint64_t present_by_c = 0;  ///< likewise once the belief of the present round says C, those of a plan's later
                                   ///< rounds staying what they are; without plans the same as changed_by_c
  std::uint64_t present_by_d = 0;  ///< likewise D

  BeliefEffect& operator+=(const BeliefEffect& more) {
    rounds += more.rounds;
    changed_by_c += more.changed_by_c;
    changed_by_d += more.changed_by_d;
    present_by_c += more.present_by_c;
    present_by_d += more.present_by_d;
    return *this;
  }

  bool operator==(const BeliefEffect&) const = default;
};

/// A belief that changes nothing is decoration: an intervention on the belief alone, in the situations that the
/// policy (playing its own target, greedily) meets over the rounds that it was trained for. What is forced is the
/// belief token or, of a policy that plans, all that its plan asks of the belief head.
/// All zero but the rounds for a policy whose stream has no belief token. One effect an opponent, in the roster's
/// order; all matches are played side by side. Throws Cancelled.
std::vector<BeliefEffect> belief_effects(const std::shared_ptr<const Mind>& mind, const std::vector<Strategy>& roster,
                                         unsigned threads = 1, const Progress& progress = nullptr);

/// The sum of belief_effects.
BeliefEffect belief_effect(const std::shared_ptr<const Mind>& mind, const std::vector<Strategy>& roster,
                           unsigned threads = 1, const Progress& progress = nullptr);

}  // namespace folk::sct
