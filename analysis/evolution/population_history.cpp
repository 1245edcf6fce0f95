#include <folk/analysis/evolution/population_history.h>

#include <algorithm>
#include <utility>

namespace folk {

std::uint64_t PopulationHistory::always_kept(std::size_t strategies) {
  return std::min<std::uint64_t>(256, most_numbers / (4 * std::max<std::size_t>(strategies, 1)));
}

void PopulationHistory::add(std::uint64_t generation, const Population& population) {
  const std::uint64_t first = always_kept(population.size());
  const auto kept = [&](std::uint64_t g) { return g < first || g % stride_ == 0; };
  if (!kept(generation)) return;
  rows_.push_back({generation, population});
  while (rows_.size() > first + 2 && rows_.size() * population.size() > most_numbers) {
    stride_ *= 2;
    std::erase_if(rows_, [&](const Row& row) { return !kept(row.generation); });
  }
}

Population PopulationHistory::mean_of_last_quarter() const {
  if (rows_.empty()) return {};
  Population mean(rows_.front().population.size(), 0);
  const std::uint64_t last = rows_.back().generation;
  double count = 0;
  for (const auto& [generation, population] : rows_) {
    if (generation < last - last / 4) continue;
    ++count;
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += population[i];
  }
  for (double& number : mean) number /= count;
  return mean;
}

PopulationHistory PopulationHistory::restored(std::uint64_t stride, std::vector<Row> rows) {
  PopulationHistory history;
  history.stride_ = stride;
  history.rows_ = std::move(rows);
  return history;
}

}  // namespace folk
