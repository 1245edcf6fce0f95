#include <fmt/format.h>
#include <folk/games/error.h>
#include <folk/strategies/memory_one.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace folk {
namespace {

struct Letters {
  double t, r, p, s;
};

Letters letters(const Payoffs& payoffs) {
  prisoners_dilemma(payoffs.temptation, payoffs.reward, payoffs.punishment, payoffs.sucker);
  return {to_double(payoffs.temptation), to_double(payoffs.reward), to_double(payoffs.punishment),
          to_double(payoffs.sucker)};
}

/// Rounding may leave a feasible probability a hair outside [0, 1].
std::array<double, 4> clamped(std::array<double, 4> p) {
  for (double& x : p) x = std::clamp(x, 0.0, 1.0);
  return p;
}

}  // namespace

Automaton memory_one(double first, const std::array<double, 4>& after) {
  // State 0 is the start, state 1 + o what follows outcome o.
  std::vector<Automaton::Node> nodes{{first, {1, 2, 3, 4}}};
  for (const double cooperation : after) nodes.push_back({cooperation, {1, 2, 3, 4}});
  return Automaton(std::move(nodes), 0);
}

std::array<double, 4> zero_determinant(const Payoffs& payoffs, Baseline baseline, double chi,
                                       std::optional<double> phi) {
  const auto [t, r, p, s] = letters(payoffs);
  if (!(chi >= 1 && std::isfinite(chi)))
    throw UsageError(fmt::format("zero-determinant slope chi = {}: expected a number of at least 1", chi));
  // Press & Dyson 2012, eq. 7-8: (pCC - 1, pCD - 1, pDC, pDD) = phi/(B - S) [(own - B) - chi (their - B)].
  const double b = baseline == Baseline::punishment ? p : r;
  const std::array<double, 4> own{r, s, t, p};
  const std::array<double, 4> their{r, t, s, p};
  std::array<double, 4> slope{};
  double largest = std::numeric_limits<double>::infinity();
  for (std::size_t o = 0; o < 4; ++o) {
    slope[o] = ((own[o] - b) - chi * (their[o] - b)) / (b - s);
    if (slope[o] != 0) largest = std::min(largest, 1 / std::abs(slope[o]));
  }
  const double scale = phi.value_or(largest / 2);
  if (!(scale > 0 && scale <= largest * (1 + 1e-12)))
    throw UsageError(
        fmt::format("zero-determinant strategy with chi = {}: phi = {} is not feasible, it must be above 0 "
                    "and at most {}",
                    chi, scale, largest));
  return clamped({1 + scale * slope[0], 1 + scale * slope[1], scale * slope[2], scale * slope[3]});
}

std::array<double, 4> equalizer(const Payoffs& payoffs, double v, std::optional<double> p_cc,
                                std::optional<double> p_dd) {
  const auto [t, r, p, s] = letters(payoffs);
  if (!(v >= p && v <= r))
    throw UsageError(fmt::format("equalizer: v = {} is not feasible, it must be from P = {} to R = {}", v, p, r));
  // (pCC - 1, pCD - 1, pDC, pDD) = -scale (their payoff - v), Press & Dyson 2012.
  double scale = 0.5 / std::max(t - v, v - s);
  if (p_cc && v < r) {
    scale = (1 - *p_cc) / (r - v);
  } else if (p_dd && v > p) {
    scale = *p_dd / (v - p);
  }
  const std::array<double, 4> found{1 - scale * (r - v), 1 - scale * (t - v), scale * (v - s), scale * (v - p)};
  constexpr double slack = 1e-9;
  if ((p_cc && std::abs(*p_cc - found[0]) > slack) || (p_dd && std::abs(*p_dd - found[3]) > slack))
    throw UsageError(fmt::format("equalizer({}): pCC and pDD are tied, with pCC = {} pDD must be {}", v,
                                 p_cc.value_or(found[0]), found[3]));
  for (const double x : found)
    if (!(x >= -slack && x <= 1 + slack) || scale <= 0)
      throw UsageError(
          fmt::format("equalizer({}): pCC = {} and pDD = {} are not feasible, they need pCD = {:.6g} and "
                      "pDC = {:.6g}",
                      v, found[0], found[3], found[1], found[2]));
  return clamped(found);
}

}  // namespace folk
