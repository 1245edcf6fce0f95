#include <folk/analysis/play/whole_payoffs.h>
#include <folk/games/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace folk {

WholePayoffs whole_payoffs(const Payoffs& payoffs, const std::vector<Rational>& others) {
  const auto exact = payoffs.by_outcome();
  Integer common = 1;
  for (const auto& payoff : exact) common = lcm(common, denominator(payoff));
  for (const auto& payoff : others) common = lcm(common, denominator(payoff));
  WholePayoffs whole;
  whole.scale = to_double(common);
  whole.exact_scale = Rational(common);
  for (std::size_t o = 0; o < 4; ++o) {
    whole.by_outcome[o] = to_double(exact[o] * common);
    whole.largest = std::max(whole.largest, std::abs(whole.by_outcome[o]));
  }
  if (!(whole.largest <= 0x1p53) || !std::isfinite(whole.scale))
    throw UsageError(fmt::format("payoffs {}: too large or of too many digits to add up", to_text(payoffs)));
  return whole;
}

}  // namespace folk
