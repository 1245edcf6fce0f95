#pragma once
// What a training step sees: windows of several matches, packed without padding.

#include <folk/sct/network/architecture.h>

#include <cstdint>
#include <span>
#include <vector>

namespace folk::sct {

/// Actions of every round: classes [rounds, players] where actions are discrete, else numbers [rounds, players, size].
template <class S>
struct Actions {
  std::vector<std::int32_t> classes;
  std::vector<S> numbers;
};

/// Windows one after the other, each of up to `context` rounds.
template <class S>
struct Batch {
  std::vector<std::size_t> window_rounds;  ///< [windows]
  std::vector<S> returns;                  ///< to go, scaled  [rounds]
  std::vector<S> observations;             ///< [rounds, agents, observation_size]
  std::vector<std::int32_t> timesteps;     ///< rows of the time table  [rounds]
  Actions<S> opponent;                     ///< one opponent
  std::vector<S> belief_targets;           ///< probability of each class; empty: as moved  [rounds, action_size]
  Actions<S> own;                          ///< of each agent, as played: what the action tokens say
  Actions<S> wanted;                       ///< of each agent, what the policy loss asks for; empty: as played
  std::vector<S> action_weights;           ///< of each round in the policy loss; empty: all 1  [rounds]
  std::vector<S> next_observations;        ///< [rounds, agents, observation_size], for the auxiliary heads
  std::vector<S> next_returns;             ///< [rounds], for the auxiliary heads

  /// What the policy loss asks for.
  const Actions<S>& policy_target() const { return wanted.classes.empty() && wanted.numbers.empty() ? own : wanted; }

  std::size_t windows() const { return window_rounds.size(); }
  std::size_t rounds() const { return timesteps.size(); }
};

/// Windows [first, first + rounds_of.size()) of a batch, whose first round is `first_round`.
template <class S>
struct Chunk {
  const Batch<S>& batch;
  std::size_t first_window;
  std::size_t first_round;
  std::span<const std::size_t> window_rounds;

  std::size_t rounds() const {
    std::size_t sum = 0;
    for (const auto length : window_rounds) sum += length;
    return sum;
  }
};

}  // namespace folk::sct
