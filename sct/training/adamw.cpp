#include <folk/sct/training/adamw.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace folk::sct {

double AdamWSettings::rate(std::uint64_t step) const {
  double rate = learning_rate;
  if (warmup_steps > 0) rate *= std::min(1.0, static_cast<double>(step + 1) / static_cast<double>(warmup_steps));
  if (decay_steps == 0) return rate;
  const double done = std::min(1.0, static_cast<double>(step) / static_cast<double>(decay_steps));
  return rate * 0.5 * (1 + std::cos(std::numbers::pi * done));
}

template <class S>
double norm(std::span<const S> gradient) {
  std::array<double, 16> sums{};  // side by side, so that the sum goes as fast as memory
  std::size_t i = 0;
  for (; i + sums.size() <= gradient.size(); i += sums.size())
    for (std::size_t k = 0; k < sums.size(); ++k) {
      const double x = static_cast<double>(gradient[i + k]);
      sums[k] += x * x;
    }
  double sum = 0;
  for (; i < gradient.size(); ++i) sum += static_cast<double>(gradient[i]) * static_cast<double>(gradient[i]);
  for (const double part : sums) sum += part;
  return std::sqrt(sum);
}

template <class S>
double adamw_step(const AdamWSettings& settings, std::span<const std::pair<std::size_t, std::size_t>> parts,
                  std::span<const S> gradient, AdamWState<S>& state, std::span<S> parameters) {
  state.first.resize(parameters.size());
  state.second.resize(parameters.size());
  const double length = norm(gradient);
  const double rate = settings.rate(state.steps);
  ++state.steps;
  const double steps = static_cast<double>(state.steps);
  const S clip = static_cast<S>(std::min(1.0, settings.clip / (length + 1e-6)));
  const S beta_1 = static_cast<S>(settings.beta_1);
  const S beta_2 = static_cast<S>(settings.beta_2);
  const S keep = static_cast<S>(1 - rate * settings.weight_decay);
  const S step = static_cast<S>(rate / (1 - std::pow(settings.beta_1, steps)));
  const S correction = static_cast<S>(1 / std::sqrt(1 - std::pow(settings.beta_2, steps)));
  const S epsilon = static_cast<S>(settings.epsilon);
  for (const auto& [begin, end] : parts)
    for (std::size_t i = begin; i < end; ++i) {
      const S g = gradient[i] * clip;
      S& m = state.first[i];
      S& v = state.second[i];
      m = beta_1 * m + (S(1) - beta_1) * g;
      v = beta_2 * v + (S(1) - beta_2) * g * g;
      parameters[i] = parameters[i] * keep - step * m / (std::sqrt(v) * correction + epsilon);
    }
  return length;
}

template double norm(std::span<const float>);
template double norm(std::span<const double>);
template double adamw_step(const AdamWSettings&, std::span<const std::pair<std::size_t, std::size_t>>,
                           std::span<const float>, AdamWState<float>&, std::span<float>);
template double adamw_step(const AdamWSettings&, std::span<const std::pair<std::size_t, std::size_t>>,
                           std::span<const double>, AdamWState<double>&, std::span<double>);

}  // namespace folk::sct
