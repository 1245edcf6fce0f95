#pragma once
// Networks in their plainest form, in double, to hold faster ones against; and derivatives by finite differences.

#include <folk/mpe/network/mlp.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace folk::mpe::test {

inline std::vector<double> as_double(const std::vector<float>& numbers) { return {numbers.begin(), numbers.end()}; }

/// Layer after layer of sums.
inline std::vector<double> plain_network(const MlpShape& shape, const double* parameters, std::vector<double> x) {
  for (std::size_t layer = 0; layer < shape.layers(); ++layer) {
    std::vector<double> y(shape.widths()[layer + 1]);
    for (std::size_t i = 0; i < y.size(); ++i) {
      y[i] = parameters[shape.bias(layer) + i];
      for (std::size_t k = 0; k < x.size(); ++k) y[i] += parameters[shape.weight(layer) + i * x.size() + k] * x[k];
      if (layer + 1 < shape.layers()) y[i] = std::max(0.0, y[i]);
    }
    x = std::move(y);
  }
  return x;
}

inline std::vector<double> joined(std::vector<double> one, const std::vector<double>& other) {
  one.insert(one.end(), other.begin(), other.end());
  return one;
}

/// The numbers of a row of a matrix.
template <class S>
std::vector<double> row_of(const Matrix<S>& matrix, std::size_t row) {
  std::vector<double> numbers;
  for (Index c = 0; c < matrix.cols(); ++c) numbers.push_back(static_cast<double>(matrix(index(row), c)));
  return numbers;
}

/// The derivative of `outcome` in one number, which is put back.
inline double difference(double& number, const std::function<double()>& outcome, double h = 1e-6) {
  const double here = number;
  number = here + h;
  const double above = outcome();
  number = here - h;
  const double below = outcome();
  number = here;
  return (above - below) / (2 * h);
}

/// What the mixer makes of values at a state.
inline double plain_mix(const MlpShape& layer, const double* parameters, const std::vector<double>& state,
                        const std::vector<double>& values) {
  const auto numbers = plain_network(layer, parameters, state);
  double total = 0;
  double sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    double share = 1e-10;
    for (std::size_t k = 0; k < 32; ++k)
      share += std::abs(numbers[32 * i + k]) * std::abs(numbers[32 * values.size() + k]);
    total += share;
    sum += share * values[i];
  }
  return sum / total;
}

}  // namespace folk::mpe::test
