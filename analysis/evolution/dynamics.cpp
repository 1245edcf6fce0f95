#include <folk/analysis/evolution/dynamics.h>

namespace folk {

std::size_t drawn_by(const std::vector<double>& weights, RandomStream& random) {
  double sum = 0;
  for (const double weight : weights) sum += weight;
  double left = random.uniform() * sum;
  std::size_t last = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (!(weights[i] > 0)) continue;
    last = i;
    left -= weights[i];
    if (left < 0) return i;
  }
  return last;  // of rounding
}

}  // namespace folk
