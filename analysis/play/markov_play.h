#pragma once
// Two finite machines that mix or slip: expected outcomes by their joint Markov chain, without sampling.

#include <folk/analysis/play/pair_result.h>
#include <folk/games/criterion.h>
#include <folk/games/noise.h>
#include <folk/strategies/automaton.h>

#include <cstddef>
#include <cstdint>
#include <optional>

namespace folk {

/// What an exact solution may cost before sampling is the better answer.
struct MarkovLimits {
  std::size_t joint_states = 100'000;
  std::size_t solved_states = 1'000;  ///< of a chain that is solved at once
  std::uint64_t work = 200'000'000;   ///< multiplications where it is followed round by round
};

/// Expected outcome weights of the pair, each move flipping with probability `noise`; both learn the move
/// really played. finite: the distribution over joint states, round by round, or by repeated squaring where the rounds
/// are many. discounted and ending: solved at once, or round by round where the chain is large. mean: absorption into
/// the recurrent classes, each weighted by its stationary distribution. Nothing when the limits are exceeded.
std::optional<PairResult> play_markov(const Automaton& first, const Automaton& second, Noise noise,
                                      const Criterion& criterion, const MarkovLimits& limits = {});

}  // namespace folk
