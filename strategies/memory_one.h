#pragma once
// Strategies that mix by the last round alone, zero-determinant ones (Press & Dyson 2012) among them.

#include <folk/games/payoffs.h>
#include <folk/games/rational.h>
#include <folk/strategies/automaton.h>

#include <array>
#include <optional>

namespace folk {

/// C with probability `first`, then with after[outcome of the last round] (CC, CD, DC, DD; own move first).
/// Throws UsageError when a probability is outside [0, 1].
Automaton memory_one(double first, const std::array<double, 4>& after);

/// A zero-determinant strategy: own payoff - B = chi (their payoff - B) in the long run.
enum class Baseline {
  punishment,  ///< extortion: B = P (Press & Dyson 2012)
  reward       ///< generosity: B = R (Stewart & Plotkin 2013)
};

/// The four probabilities of the zero-determinant strategy with this slope (Press & Dyson 2012, eq. 7-8):
/// (pCC - 1, pCD - 1, pDC, pDD) = phi / (B - S) [(own - B) - chi (their - B)], computed exactly and rounded once; by
/// default `phi` is half of the largest feasible one. ZDGTFT-2 of Stewart & Plotkin is B = R, chi = 2, phi = 3/8 at
/// 5, 3, 1, 0.
/// Throws UsageError unless chi >= 1, 0 < phi <= the largest feasible one, and the payoffs are a prisoner's dilemma.
std::array<double, 4> zero_determinant(const Payoffs& payoffs, Baseline baseline, const Rational& chi,
                                       const std::optional<Rational>& phi = std::nullopt);

/// The same for the decimal that a double stands for.
inline std::array<double, 4> zero_determinant(const Payoffs& payoffs, Baseline baseline, double chi) {
  return zero_determinant(payoffs, baseline, as_written(chi));
}

/// Press & Dyson's equalizer: their long-run payoff is v whatever they play. pCC and pDD are tied by
/// (1 - pCC)(v - P) = pDD (R - v); what is not given follows, by default from half of the largest feasible scale.
/// Computed exactly and rounded once. Throws UsageError unless P <= v <= R and all four are probabilities.
std::array<double, 4> equalizer(const Payoffs& payoffs, const Rational& v,
                                const std::optional<Rational>& p_cc = std::nullopt,
                                const std::optional<Rational>& p_dd = std::nullopt);

/// The same for the decimal that a double stands for.
inline std::array<double, 4> equalizer(const Payoffs& payoffs, double v) { return equalizer(payoffs, as_written(v)); }

}  // namespace folk
