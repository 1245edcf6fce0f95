#include <folk/analysis/equilibria/gap.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace folk {

Gap exact_gap(const Rational& gain, Witness witness) {
  if (gain <= 0) return {0, Rational(0), 0, std::nullopt, {}, {{}, {}, {}, std::move(witness.belief)}};
  return {to_double(gain), gain, 0, std::nullopt, {}, std::move(witness)};
}

Gap rounded_gap(double gain, double residual, Witness witness) {
  // What rounding alone can make is none.
  if (gain <= residual) return {0, std::nullopt, residual, std::nullopt, {}, {{}, {}, {}, std::move(witness.belief)}};
  return {gain, std::nullopt, residual, std::nullopt, {}, std::move(witness)};
}

double rounding_of(const Payoffs& payoffs, const Criterion& criterion) {
  double largest = 0;
  for (const double payoff : payoffs.numbers()) largest = std::max(largest, std::abs(payoff));
  return 1e-12 * largest * criterion.total_weight();
}

}  // namespace folk
