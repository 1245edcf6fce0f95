#include <fmt/format.h>
#include <folk/games/error.h>
#include <folk/strategies/memory_one.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace folk {
namespace {

/// A probability that a person rounded before writing it may miss what it is tied to by this much.
const Rational& slack() {
  static const Rational value(1, 1'000'000'000);
  return value;
}

/// Payoffs of a prisoner's dilemma.
const Payoffs& checked(const Payoffs& payoffs) {
  prisoners_dilemma(payoffs.temptation, payoffs.reward, payoffs.punishment, payoffs.sucker);
  return payoffs;
}

/// The exact probabilities, rounded once.
std::array<double, 4> rounded(const std::array<Rational, 4>& exact) {
  std::array<double, 4> p{};
  for (std::size_t o = 0; o < 4; ++o) p[o] = std::clamp(to_double(exact[o]), 0.0, 1.0);
  return p;
}

}  // namespace

Automaton memory_one(double first, const std::array<double, 4>& after) {
  // State 0 is the start, state 1 + o what follows outcome o.
  std::vector<Automaton::Node> nodes{{first, {1, 2, 3, 4}}};
  for (const double cooperation : after) nodes.push_back({cooperation, {1, 2, 3, 4}});
  return Automaton(std::move(nodes), 0);
}

std::array<double, 4> zero_determinant(const Payoffs& payoffs, Baseline baseline, const Rational& chi,
                                       const std::optional<Rational>& phi) {
  const auto& [t, r, p, s] = checked(payoffs);
  if (chi < 1)
    throw UsageError(
        fmt::format("zero-determinant slope chi = {}: expected a number of at least 1", to_short_text(chi)));
  // Press & Dyson 2012, eq. 7-8: (pCC - 1, pCD - 1, pDC, pDD) = phi/(B - S) [(own - B) - chi (their - B)].
  const Rational& b = baseline == Baseline::punishment ? p : r;
  const std::array<Rational, 4> own{r, s, t, p};
  const std::array<Rational, 4> their{r, t, s, p};
  std::array<Rational, 4> slope;
  Rational steepest;
  for (std::size_t o = 0; o < 4; ++o) {
    slope[o] = ((own[o] - b) - chi * (their[o] - b)) / (b - s);
    steepest = std::max(steepest, abs(slope[o]));
  }
  const Rational largest = 1 / steepest;  // T > S: not all slopes are 0
  const Rational scale = phi.value_or(largest / 2);
  // The largest one, rounded to a decimal, may be a hair above it.
  if (scale <= 0 || scale > largest * (1 + Rational(1, 1'000'000'000'000)))
    throw UsageError(
        fmt::format("zero-determinant strategy with chi = {}: phi = {} is not feasible, it must be above 0 "
                    "and at most {}",
                    to_short_text(chi), to_short_text(scale), to_short_text(largest)));
  return rounded({1 + scale * slope[0], 1 + scale * slope[1], scale * slope[2], scale * slope[3]});
}

std::array<double, 4> equalizer(const Payoffs& payoffs, const Rational& v, const std::optional<Rational>& p_cc,
                                const std::optional<Rational>& p_dd) {
  const auto& [t, r, p, s] = checked(payoffs);
  if (v < p || v > r)
    throw UsageError(fmt::format("equalizer: v = {} is not feasible, it must be from P = {} to R = {}",
                                 to_short_text(v), to_short_text(p), to_short_text(r)));
  // (pCC - 1, pCD - 1, pDC, pDD) = -scale (their payoff - v), Press & Dyson 2012.
  Rational scale = Rational(1, 2) / std::max(t - v, v - s);
  if (p_cc && v < r) {
    scale = (1 - *p_cc) / (r - v);
  } else if (p_dd && v > p) {
    scale = *p_dd / (v - p);
  }
  const std::array<Rational, 4> found{1 - scale * (r - v), 1 - scale * (t - v), scale * (v - s), scale * (v - p)};
  const auto far = [](const std::optional<Rational>& given, const Rational& tied) {
    return given && abs(*given - tied) > slack();
  };
  if (far(p_cc, found[0]) || far(p_dd, found[3]))
    throw UsageError(fmt::format("equalizer({}): pCC and pDD are tied, with pCC = {} pDD must be {}", to_short_text(v),
                                 to_short_text(p_cc.value_or(found[0])), to_short_text(found[3])));
  for (const Rational& x : found)
    if (x < -slack() || x > 1 + slack() || scale <= 0)
      throw UsageError(
          fmt::format("equalizer({}): pCC = {} and pDD = {} are not feasible, they need pCD = {:.6g} and "
                      "pDC = {:.6g}",
                      to_short_text(v), to_short_text(found[0]), to_short_text(found[3]), to_double(found[1]),
                      to_double(found[2])));
  return rounded(found);
}

}  // namespace folk
