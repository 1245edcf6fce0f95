#pragma once
// The random numbers of evolving populations: a stream a generation, or a stream a run.

#include <folk/games/random.h>

#include <cstdint>

namespace folk {

/// What draws; the numbers are part of what a seed means, and follow those of a match (games/match_key.h).
enum class EvolutionRole : std::uint64_t { generation = 4, run = 5 };

/// The step from generation `generation` to the next: who knows the generation can go on from there.
constexpr RandomKey generation_key(std::uint64_t seed, std::uint64_t generation) {
  return {seed, 0, generation, static_cast<std::uint64_t>(EvolutionRole::generation)};
}

/// All steps of one of many runs.
constexpr RandomKey run_key(std::uint64_t seed, std::uint64_t run) {
  return {seed, 0, run, static_cast<std::uint64_t>(EvolutionRole::run)};
}

}  // namespace folk
