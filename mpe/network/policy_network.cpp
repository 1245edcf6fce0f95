#include <folk/mpe/network/policy_network.h>
#include <folk/mpe/world/lanes.h>

#include <algorithm>
#include <cmath>

namespace folk::mpe {
namespace {

template <class S>
std::vector<S> as(const std::vector<float>& numbers) {
  return {numbers.begin(), numbers.end()};
}

/// tanh of each number, in double and always the same way, so that an action does not depend on its neighbours:
/// (exp(2x) - 1) / (exp(2x) + 1), right to 1e-16.
template <class S>
void hyperbolic_tangents(const S* from, S* to, std::size_t count) {
  for (std::size_t first = 0; first < count; first += vector_lanes) {
    const std::size_t some = std::min(vector_lanes, count - first);
    Vector x = all_lanes(0);
    for (std::size_t i = 0; i < some; ++i) x[i] = std::clamp(static_cast<double>(from[first + i]), -20.0, 20.0);
    const Vector e = exponential(2.0 * x);
    const Vector y = (e - 1.0) / (e + 1.0);
    for (std::size_t i = 0; i < some; ++i) to[first + i] = static_cast<S>(y[i]);
  }
}

}  // namespace

template <class S>
Actor<S>::Actor(const PolicyNetwork& network)
    : shape_(network.shape),
      parameters_(as<S>(network.parameters)),
      squash_(network.squash),
      normalises_(network.normalisation.has_value()) {
  if (!normalises_) return;
  const auto& normalisation = *network.normalisation;
  weight_ = as<S>(normalisation.weight);
  bias_ = as<S>(normalisation.bias);
  mean_ = as<S>(normalisation.mean);
  for (const float variance : normalisation.variance)
    deviation_.push_back(std::sqrt(static_cast<S>(variance) + static_cast<S>(normalisation.epsilon)));
}

template <class S>
Matrix<S>& Actor<S>::observations(std::size_t rows) {
  if (tape_.values.empty() || tape_.input().rows() != index(rows)) tape_.prepare(shape_, rows);
  return tape_.input();
}

template <class S>
const Matrix<S>& Actor<S>::act() {
  if (normalises_) {
    Matrix<S>& x = tape_.input();
    for (Index r = 0; r < x.rows(); ++r)
      for (Index c = 0; c < x.cols(); ++c) {
        const auto k = static_cast<std::size_t>(c);
        x(r, c) = (x(r, c) - mean_[k]) / deviation_[k] * weight_[k] + bias_[k];
      }
  }
  forward(shape_, parameters_.data(), tape_);
  squash(squash_, tape_.output(), actions_);
  return actions_;
}

template <class S>
void squash(Squash how, const Matrix<S>& raw, Matrix<S>& actions) {
  actions.resize(raw.rows(), raw.cols());
  if (how == Squash::tanh)
    hyperbolic_tangents(raw.data(), actions.data(), static_cast<std::size_t>(raw.size()));
  else
    actions = raw.array().max(S(-1)).min(S(1));
}

template class Actor<float>;
template class Actor<double>;
template void squash(Squash, const Matrix<float>&, Matrix<float>&);
template void squash(Squash, const Matrix<double>&, Matrix<double>&);

}  // namespace folk::mpe
