#include <folk/mpe/offline/transformer_windows.h>
#include <folk/mpe/world/random_stream.h>

#include <algorithm>
#include <array>
#include <vector>

namespace folk::mpe {

sct::Batch<float> draw_windows(const DataSet& data, const ObservationScale& scale, double return_scale,
                               std::size_t windows, std::size_t context, std::uint64_t seed, std::uint64_t step) {
  const auto& scenario = data.scenario();
  const std::size_t predators = scenario.predators();
  const std::size_t prey = scenario.prey();
  const std::size_t size = scenario.observation_size(0);
  const std::size_t length = std::min(context, data.episode_steps());
  RandomStream random = random_stream(seed, RandomUse::offline_batch, step);
  sct::Batch<float> batch;
  batch.window_rounds.assign(windows, length);
  const std::size_t rows = windows * length;
  batch.observations.resize(rows * predators * size);
  batch.opponent.numbers.resize(rows * 2);
  batch.own.numbers.resize(rows * predators * 2);
  std::size_t place = 0;
  for (std::size_t w = 0; w < windows; ++w) {
    const std::size_t episode = static_cast<std::size_t>(random() % data.episodes());
    const std::size_t start = static_cast<std::size_t>(random() % (data.episode_steps() - length + 1));
    const std::size_t first_row = episode * data.episode_steps();
    double to_go = 0;
    for (std::size_t t = start; t < data.episode_steps(); ++t)
      to_go += static_cast<double>(data.reward(0, first_row + t));
    for (std::size_t t = start; t < start + length; ++t, ++place) {
      const std::size_t row = first_row + t;
      batch.returns.push_back(static_cast<float>(to_go / return_scale));
      to_go -= static_cast<double>(data.reward(0, row));
      batch.timesteps.push_back(static_cast<std::int32_t>(t));
      data.action(prey, row, std::span<float, 2>(batch.opponent.numbers.data() + place * 2, 2));
      for (std::size_t i = 0; i < predators; ++i) {
        const std::span<float> seen(batch.observations.data() + (place * predators + i) * size, size);
        data.observation(i, row, seen);
        scale.apply(i, seen);
        data.action(i, row, std::span<float, 2>(batch.own.numbers.data() + (place * predators + i) * 2, 2));
      }
    }
  }
  return batch;
}

}  // namespace folk::mpe
