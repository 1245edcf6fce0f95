#pragma once
// What is asked of a policy and those it plays.

#include <folk/analysis/equilibria/equilibrium_check.h>
#include <folk/analysis/play/sampling.h>
#include <folk/analysis/thresholds/thresholds.h>
#include <folk/games/progress.h>
#include <folk/games/rational.h>
#include <folk/strategies/strategy.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace folk {

inline constexpr std::size_t default_belief_depth = 6;

/// The equilibrium question of one policy against each of some opponents. A policy or an opponent that is no machine
/// needs finite:T and no noise.
struct ExaminationQuestion : EquilibriumQuestion {
  Strategy policy;
  std::vector<Strategy> opponents;
  std::vector<Strategy>
      imitated;                  ///< what these earn against a policy that is no machine, its opponents could earn too
  Sides sides = Sides::both;     ///< whose gains a verdict is about
  double epsilon_belief = 0.05;  ///< how far a belief may lie from the truth, total variation
  Rational epsilon_payoff = 0;   ///< what a deviation may gain, in the criterion's unit
  /// Rounds of the search on the policy's own beliefs; 0: as many as it plans ahead, else default_belief_depth.
  std::size_t depth = 0;
  std::uint64_t repetitions = 100;  ///< matches of a pair that can only be sampled
  std::uint64_t seed = 1;
  unsigned threads = 1;  ///< the answers do not depend on it
  /// The round from which on is asked, after what is really played before it (continuation.h); 1: the whole match.
  std::uint64_t from = 1;

  std::size_t belief_depth() const {
    if (depth > 0) return depth;
    return policy.plans_ahead > 0 ? policy.plans_ahead : default_belief_depth;
  }

  Sampling sampling() const { return {*this, repetitions, seed, threads}; }
};

/// Told what is being done; what it returns is the progress of that.
using Stages = std::function<Progress(const std::string& stage)>;

/// Begins a stage where somebody wants to know.
inline Progress begin_stage(const Stages& stages, const std::string& stage) {
  return stages ? stages(stage) : Progress(nullptr);
}

}  // namespace folk
