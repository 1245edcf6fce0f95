#pragma once
// Where episodes begin when numpy's generator places them, as in the published program after numpy.random.seed(s).

#include <folk/mpe/evaluation/episodes.h>

#include <cstdint>
#include <vector>

namespace folk::mpe {

/// The first states of episodes 0, 1, ... of one generator seeded once, each reset going on where the last one ended.
std::vector<EpisodeState> numpy_starts(const Scenario& scenario, std::uint32_t seed, std::size_t episodes);

/// What EpisodePlan::place is for episodes that begin there; `starts` must hold every episode of the plan.
std::function<void(Batch&, std::size_t, std::uint64_t)> placed_at(std::vector<EpisodeState> starts);

}  // namespace folk::mpe
