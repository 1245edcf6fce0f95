#pragma once
// One episode as it went, step by step: to be drawn, written down, and replayed.

#include <folk/mpe/evaluation/episodes.h>
#include <folk/mpe/world/batch.h>

#include <cstdint>
#include <string>
#include <vector>

namespace folk::mpe {

struct EpisodeRecord {
  /// The action that led to a row's state, what the agents observe there and what they earned by it.
  struct Row {
    EpisodeState state;
    std::vector<Point> actions;                     ///< of each agent; 0 in the first row
    std::vector<std::vector<double>> observations;  ///< of each agent
    std::vector<double> rewards;                    ///< of each agent; 0 in the first row
  };

  Scenario scenario;
  std::vector<Row> rows;  ///< the reset, then one a step
  std::string predators;  ///< who played; empty where it is not known
  std::string prey;
  std::uint64_t seed = 0;
  std::uint64_t number = 0;  ///< of the episode
};

/// Plays episode `number` of a seed. Throws what play_episodes throws.
EpisodeRecord record_episode(const Layout& layout, const Cast& cast, std::uint64_t seed, std::uint64_t number);

/// Plays the first episode of a plan.
EpisodeRecord record_episode(const Layout& layout, const Cast& cast, EpisodePlan plan);

}  // namespace folk::mpe
