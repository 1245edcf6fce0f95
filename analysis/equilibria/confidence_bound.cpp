#include <folk/analysis/equilibria/confidence_bound.h>

#include <cmath>
#include <stdexcept>

namespace folk {

double bernstein_bound(double variance, double range, std::size_t samples, double failure) {
  if (!(variance >= 0) || !(range >= 0)) throw std::logic_error("a variance and a range are 0 or more");
  if (!(failure > 0 && failure < 1)) throw std::logic_error("a bound fails with a probability between 0 and 1");
  if (samples < 2) return range;
  const double log = std::log(2 / failure);
  const auto n = static_cast<double>(samples);
  return std::sqrt(2 * variance * log / n) + 7 * range * log / (3 * (n - 1));
}

}  // namespace folk
