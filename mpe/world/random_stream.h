#pragma once
// What random numbers of the particle world are for: the keys of their streams.

#include <folk/games/random.h>

#include <cstdint>

namespace folk::mpe {

/// Each use has streams of its own, numbered after those of the repeated games.
enum class RandomUse : std::uint64_t {
  reset = 1000,
  prey,
  coin,            ///< of a blend
  shared_coin,     ///< of a blend that flips one for a whole batch
  predators,       ///< and the agents after the first
  initial = 2000,  ///< parameters of a network
  exploration,
  replay,
  target_noise,
  data_noise,
  offline_batch = 3000,  ///< which rows or windows a step learns from
  offline_dropout,
  latent,      ///< of a variational autoencoder
  candidates,  ///< actions among which the best is sought
  policy       ///< of a policy that draws its actions
};

/// Random numbers of one use in one step of one episode. `seed` and the episode's number are those of the batch.
inline RandomStream random_stream(std::uint64_t seed, RandomUse use, std::uint64_t episode, std::uint64_t step = 0,
                                  std::uint64_t agent = 0) {
  return RandomStream({seed, episode, step, static_cast<std::uint64_t>(use) + (agent << 32U)});
}

/// Uniform in [low, high). Inlined always, for the reason that lanes.h gives.
[[gnu::always_inline]] inline double uniform(RandomStream& random, double low, double high) {
  return low + (high - low) * random.uniform();
}

}  // namespace folk::mpe
