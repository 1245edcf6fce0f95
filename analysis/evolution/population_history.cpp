#include <folk/analysis/evolution/population_history.h>

#include <algorithm>
#include <utility>

namespace folk {

void PopulationHistory::add(std::uint64_t generation, const Population& population) {
  if (generation % stride_ != 0) return;
  rows_.push_back({generation, population});
  while (rows_.size() > 2 && rows_.size() * population.size() > most_numbers) {
    stride_ *= 2;
    std::erase_if(rows_, [&](const Row& row) { return row.generation % stride_ != 0; });
  }
}

Population PopulationHistory::mean_of_last_quarter() const {
  if (rows_.empty()) return {};
  const std::size_t count = std::max<std::size_t>(1, rows_.size() / 4);
  Population mean(rows_.front().population.size(), 0);
  for (std::size_t r = rows_.size() - count; r < rows_.size(); ++r)
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += rows_[r].population[i];
  for (double& number : mean) number /= static_cast<double>(count);
  return mean;
}

PopulationHistory PopulationHistory::restored(std::uint64_t stride, std::vector<Row> rows) {
  PopulationHistory history;
  history.stride_ = stride;
  history.rows_ = std::move(rows);
  return history;
}

}  // namespace folk
