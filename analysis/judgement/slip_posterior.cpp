#include <folk/analysis/judgement/slip_posterior.h>
#include <folk/games/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace folk {

bool SlipPosterior::possible() const { return std::isfinite(log_evidence); }

std::size_t SlipPosterior::likeliest() const {
  return static_cast<std::size_t>(std::max_element(candidates.begin(), candidates.end()) - candidates.begin());
}

SlipPosterior slip_posterior(const std::vector<double>& weights,
                             const std::vector<std::vector<double>>& log_likelihoods) {
  if (weights.empty()) throw UsageError("nobody to judge the play by: give strategies");
  const std::size_t slips = log_likelihoods.front().size();
  if (slips == 0) throw UsageError("no slip rate to judge the play by: give one");
  constexpr double impossible = -std::numeric_limits<double>::infinity();
  SlipPosterior posterior{std::vector<double>(weights.size(), 0), std::vector<double>(slips, 0),
                          std::vector<std::size_t>(weights.size(), 0), impossible};
  double all = 0;
  for (const double weight : weights) all += weight;
  const auto log_joint = [&](std::size_t candidate, std::size_t slip) {
    return std::log(weights[candidate] / all) - std::log(static_cast<double>(slips)) + log_likelihoods[candidate][slip];
  };
  // Likelihoods of long records are far below the least double: all are taken relative to the largest.
  double largest = impossible;
  for (std::size_t c = 0; c < weights.size(); ++c) {
    const auto& own = log_likelihoods[c];
    posterior.likeliest_slip[c] = static_cast<std::size_t>(std::max_element(own.begin(), own.end()) - own.begin());
    largest = std::max(largest, log_joint(c, posterior.likeliest_slip[c]));
  }
  if (std::isinf(largest)) return posterior;
  double sum = 0;
  for (std::size_t c = 0; c < weights.size(); ++c) {
    for (std::size_t s = 0; s < slips; ++s) {
      const double share = std::exp(log_joint(c, s) - largest);
      posterior.candidates[c] += share;
      posterior.slips[s] += share;
      sum += share;
    }
  }
  for (auto* margin : {&posterior.candidates, &posterior.slips})
    for (double& share : *margin) share /= sum;
  posterior.log_evidence = largest + std::log(sum);
  return posterior;
}

std::vector<double> usual_slips() { return {0, 0.002, 0.005, 0.01, 0.02, 0.035, 0.05, 0.075, 0.1, 0.15, 0.2, 0.3}; }

void check_slips(const std::vector<double>& slips) {
  if (slips.empty()) throw UsageError("no slip rate to judge the play by: give one");
  for (std::size_t i = 0; i < slips.size(); ++i) {
    if (!(slips[i] >= 0 && slips[i] < 0.5))
      throw UsageError(fmt::format("a slip rate of {}: expected 0 to less than 0.5", slips[i]));
    if (std::find(slips.begin(), slips.begin() + static_cast<std::ptrdiff_t>(i), slips[i]) !=
        slips.begin() + static_cast<std::ptrdiff_t>(i))
      throw UsageError(fmt::format("the slip rate {} is given twice", slips[i]));
  }
}

}  // namespace folk
