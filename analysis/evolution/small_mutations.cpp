#include <folk/analysis/evolution/small_mutations.h>
#include <folk/games/error.h>

#include <cmath>
#include <cstddef>

namespace folk {
namespace {

template <class Number>
using Square = std::vector<std::vector<Number>>;

/// The strategies that the chain comes back to for ever. Throws UndecidedError when there are several such sets.
template <class Number>
std::vector<std::size_t> recurrent(const Square<Number>& rates) {
  const std::size_t n = rates.size();
  std::vector<std::size_t> found;
  bool all_reached = true;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) all_reached = all_reached && (i == j || rates[i][j] > Number(0));
  if (all_reached) {
    for (std::size_t i = 0; i < n; ++i) found.push_back(i);
    return found;
  }
  std::vector<std::vector<bool>> reaches(n, std::vector<bool>(n, false));
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<std::size_t> open{i};
    reaches[i][i] = true;
    while (!open.empty()) {
      const std::size_t at = open.back();
      open.pop_back();
      for (std::size_t j = 0; j < n; ++j)
        if (!reaches[i][j] && rates[at][j] > Number(0)) {
          reaches[i][j] = true;
          open.push_back(j);
        }
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    bool stays = true;
    for (std::size_t j = 0; j < n; ++j) stays = stays && (!reaches[i][j] || reaches[j][i]);
    if (stays) found.push_back(i);
  }
  for (const std::size_t i : found)
    if (!reaches[found.front()][i])
      throw UndecidedError(
          "some strategies can never be left, or with a probability below 10^-4900: where rare "
          "mutations lead depends on the start; choose a smaller intensity or population");
  return found;
}

template <class Number>
std::vector<Number> stationary(const Square<Number>& rates, const Progress& progress) {
  const auto states = recurrent(rates);
  const std::size_t k = states.size();
  Square<Number> q(k, std::vector<Number>(k));
  for (std::size_t i = 0; i < k; ++i)
    for (std::size_t j = 0; j < k; ++j) q[i][j] = i == j ? Number(0) : rates[states[i]][states[j]];
  for (std::size_t last = k; last-- > 1;) {
    Number down(0);
    for (std::size_t j = 0; j < last; ++j) down += q[last][j];
    for (std::size_t i = 0; i < last; ++i) q[i][last] /= down;
    for (std::size_t i = 0; i < last; ++i)
      for (std::size_t j = 0; j < last; ++j)
        if (i != j) q[i][j] += q[i][last] * q[last][j];
    progress(static_cast<double>(k - last) / static_cast<double>(k - 1));
  }
  if (k == 1) progress(1);
  std::vector<Number> weights(k, Number(0));
  weights[0] = 1;
  Number sum(1);
  for (std::size_t j = 1; j < k; ++j) {
    for (std::size_t i = 0; i < j; ++i) weights[j] += weights[i] * q[i][j];
    sum += weights[j];
  }
  std::vector<Number> distribution(rates.size(), Number(0));
  for (std::size_t i = 0; i < k; ++i) distribution[states[i]] = weights[i] / sum;
  return distribution;
}

template <class Number, class Value>
Square<Number> rates_of(std::size_t n, Value value) {
  Square<Number> rates(n, std::vector<Number>(n));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) rates[i][j] = value(i * n + j);
  return rates;
}

}  // namespace

std::vector<double> small_mutation_distribution(const FixationProbabilities& fixation, const Progress& progress) {
  const auto rates =
      rates_of<long double>(fixation.strategies, [&](std::size_t at) { return std::exp(fixation.logarithms[at]); });
  const auto found = stationary(rates, progress);
  return {found.begin(), found.end()};
}

std::vector<Rational> exact_small_mutation_distribution(const FixationProbabilities& fixation,
                                                        const Progress& progress) {
  if (fixation.exact.empty()) throw UsageError("the exact distribution needs exact fixation probabilities");
  return stationary(rates_of<Rational>(fixation.strategies, [&](std::size_t at) { return fixation.exact[at]; }),
                    progress);
}

std::vector<Rational> stationarity_residual(const FixationProbabilities& fixation,
                                            const std::vector<Rational>& distribution) {
  const std::size_t n = fixation.strategies;
  std::vector<Rational> residual(n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      if (i != j) {
        const Rational flow = distribution[i] * fixation.exact[i * n + j];
        residual[j] += flow;
        residual[i] -= flow;
      }
  return residual;
}

}  // namespace folk
