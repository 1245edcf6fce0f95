#include <folk/analysis/play/parallel.h>
#include <folk/mpe/data/observation_scale.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace folk::mpe {
namespace {

constexpr std::size_t rows_in_piece = 1600;

/// The mean of (x - centre)^power over all numbers x that an agent observes; the pieces' sums are added in their order.
template <int power>
double moment(const DataSet& data, std::size_t agent, double centre, unsigned threads) {
  const std::size_t width = data.scenario().observation_size(agent);
  std::vector<double> sums((data.transitions() + rows_in_piece - 1) / rows_in_piece);
  parallel_for(sums.size(), threads, [&](std::size_t piece, unsigned) {
    std::vector<float> numbers(width);
    const std::size_t begin = piece * rows_in_piece;
    for (std::size_t row = begin; row < std::min(begin + rows_in_piece, data.transitions()); ++row) {
      data.observation(agent, row, numbers);
      for (const float number : numbers) {
        const double distance = static_cast<double>(number) - centre;
        sums[piece] += power == 1 ? distance : distance * distance;
      }
    }
  });
  double sum = 0;
  for (const double part : sums) sum += part;
  return sum / (static_cast<double>(data.transitions()) * static_cast<double>(width));
}

}  // namespace

ObservationScale measured_scale(const DataSet& data, unsigned threads) {
  ObservationScale scale;
  for (std::size_t predator = 0; predator < data.scenario().predators(); ++predator) {
    const double mean = moment<1>(data, predator, 0, threads);
    scale.mean.push_back(static_cast<float>(mean));
    scale.deviation.push_back(static_cast<float>(std::sqrt(moment<2>(data, predator, mean, threads)) + 1e-6));
  }
  return scale;
}

}  // namespace folk::mpe
