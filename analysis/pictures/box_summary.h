#pragma once
// A sample in the five numbers and the outliers of a box plot.

#include <optional>
#include <vector>

namespace folk {

/// A sample as Tukey's box plot shows it.
struct BoxSummary {
  double mean = 0;
  double median = 0;
  double lower_quartile = 0;  ///< quartiles interpolate between order statistics (R's type 7, NumPy's default)
  double upper_quartile = 0;
  double lower_whisker = 0;      ///< the lowest value within 1.5 interquartile ranges of the box
  double upper_whisker = 0;      ///< the highest such value
  std::vector<double> outliers;  ///< what lies beyond the whiskers, ascending
};

/// The summary of the finite values, or nothing when there are none.
std::optional<BoxSummary> box_summary(std::vector<double> values);

}  // namespace folk
