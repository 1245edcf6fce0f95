#include <folk/mpe/evaluation/numpy_starts.h>

#include <memory>
#include <utility>

namespace folk::mpe {

std::vector<EpisodeState> numpy_starts(const Scenario& scenario, std::uint32_t seed, std::size_t episodes) {
  NumpyRandom random(seed);
  Batch batch(scenario, 1);
  std::vector<EpisodeState> starts;
  for (std::size_t e = 0; e < episodes; ++e) {
    batch.reset_episode(0, random);
    starts.push_back(batch.state(0));
  }
  return starts;
}

std::function<void(Batch&, std::size_t, std::uint64_t)> placed_at(std::vector<EpisodeState> starts) {
  return [all = std::make_shared<const std::vector<EpisodeState>>(std::move(starts))](
             Batch& batch, std::size_t episode, std::uint64_t number) { batch.set_state(episode, all->at(number)); };
}

}  // namespace folk::mpe
