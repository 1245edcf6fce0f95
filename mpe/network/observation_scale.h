#pragma once
// The scale on which networks that look at windows of observations see them.

#include <cstddef>
#include <span>
#include <vector>

namespace folk::mpe {

/// One mean and one deviation a predator, for all numbers that it observes alike, as the published transformer has it
/// (Li et al., arXiv 2310.04579); floats, as policy files keep them.
struct ObservationScale {
  std::vector<float> mean;
  std::vector<float> deviation;

  std::size_t predators() const { return mean.size(); }

  /// numbers = (numbers - mean) / deviation.
  void apply(std::size_t predator, std::span<float> numbers) const {
    const float centre = mean[predator];
    const float unit = deviation[predator];
    for (float& number : numbers) number = (number - centre) / unit;
  }

  bool operator==(const ObservationScale&) const = default;
};

}  // namespace folk::mpe
