#pragma once
// Training runs of seconds, and memories filled at random.

#include <folk/mpe/online/training.h>
#include <folk/mpe/players/scripted.h>
#include <folk/mpe/world/batch.h>
#include <folk/mpe/world/random_stream.h>

#include <cstdint>

namespace folk::mpe::test {

inline OnlineSettings small_settings() {
  OnlineSettings settings;
  settings.hidden = 8;
  settings.batch = 48;
  settings.memory = 1600 * 3;  // three rounds: the ring goes round
  settings.first_update = 1600;
  settings.update_every = 400;
  settings.episodes = 64 * 8;
  settings.evaluate_every = 128;
  settings.evaluation_episodes = 20;
  return settings;
}

/// Rounds with random actions.
inline ReplayMemory random_memory(const Layout& layout, std::size_t rounds) {
  ReplayMemory memory(layout, rounds * 1600);
  Batch batch(layout.scenario(), round_episodes);
  for (std::size_t round = 0; round < rounds; ++round) {
    batch.reset(7, round * round_episodes);
    const Block block = batch.block(0);
    RandomStream random({.seed = round});
    memory.begin_round();
    for (std::size_t s = 0; s <= layout.scenario().episode_steps; ++s) {
      memory.observe(layout, block, s);
      for (std::size_t i = 0; i < layout.action_rows() * block_lanes; ++i) block.actions[i] = uniform(random, -1, 1);
      memory.act(layout, block, s);
      if (s == layout.scenario().episode_steps) break;
      step(layout, block);
      memory.reward(layout, block, s);
    }
  }
  return memory;
}

}  // namespace folk::mpe::test
