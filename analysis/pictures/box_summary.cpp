#include <folk/analysis/pictures/box_summary.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace folk {
namespace {

double quantile(const std::vector<double>& sorted, double q) {
  const double place = q * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

}  // namespace

std::optional<BoxSummary> box_summary(std::vector<double> values) {
  values.erase(std::remove_if(values.begin(), values.end(), [](double v) { return !std::isfinite(v); }), values.end());
  if (values.empty()) return std::nullopt;
  std::sort(values.begin(), values.end());
  BoxSummary box;
  box.mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  box.median = quantile(values, 0.5);
  box.lower_quartile = quantile(values, 0.25);
  box.upper_quartile = quantile(values, 0.75);
  const double reach = 1.5 * (box.upper_quartile - box.lower_quartile);
  // A quartile may lie between two values: a whisker never ends inside the box.
  box.lower_whisker = box.lower_quartile;
  box.upper_whisker = box.upper_quartile;
  for (const double value : values) {
    if (value < box.lower_quartile - reach || value > box.upper_quartile + reach) {
      box.outliers.push_back(value);
    } else {
      box.lower_whisker = std::min(box.lower_whisker, value);
      box.upper_whisker = std::max(box.upper_whisker, value);
    }
  }
  return box;
}

}  // namespace folk
