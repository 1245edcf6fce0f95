#pragma once
// With which probability a few mutants take over a finite population: the birth-death formula.

#include <folk/analysis/evolution/score_matrix.h>
#include <folk/analysis/evolution/selection_rules.h>
#include <folk/games/progress.h>

#include <array>
#include <cstdint>
#include <vector>

namespace folk {

/// Payoffs a round between mutants A and residents B.
template <class Number>
struct TwoTypes {
  Number aa{}, ab{}, ba{}, bb{};
};

/// rho_i, the probability that i mutants of N take over (Karlin & Taylor 1975, 4.7; Nowak et al. 2004, Taylor et al.
/// 2004):
///   rho_i = (1 + sum_{k=1}^{i-1} prod_{j=1}^{k} g_j) / (1 + sum_{k=1}^{N-1} prod_{j=1}^{k} g_j),
/// g_j being T-/T+ with j mutants: the fitness of a resident over that of a mutant in birth-death, and
/// exp(-w (pi_A - pi_B)) in pairwise comparison. N >= 2, 0 <= i <= N, N <= 10^7. Sums of logarithms: a relative error
/// of some 10^-16, also where the probability itself is below any double (the logarithm is what is returned).
/// Throws UsageError on rules and numbers out of range.
long double log_fixation_probability(const TwoTypes<double>& payoffs, std::uint64_t population, std::uint64_t mutants,
                                     const SelectionRules& rules);

/// exp of it.
double fixation_probability(const TwoTypes<double>& payoffs, std::uint64_t population, std::uint64_t mutants,
                            const SelectionRules& rules);

/// The largest population whose fixation probabilities are computed as fractions.
inline constexpr std::uint64_t most_exact = 1000;

/// The same as a fraction, of birth-death with linear fitness. Throws UsageError for any other rules, and for more than
/// most_exact individuals.
Rational exact_fixation_probability(const TwoTypes<Rational>& payoffs, std::uint64_t population, std::uint64_t mutants,
                                    const SelectionRules& rules);

/// Of a single mutant of each strategy (column) in a population of each other (row), 1 on the diagonal.
struct FixationProbabilities {
  std::size_t strategies = 0;
  std::uint64_t population = 0;
  std::vector<long double> logarithms;  ///< row by row
  std::vector<Rational> exact;          ///< the same as fractions, empty unless asked for

  /// mutant in resident.
  double probability(std::size_t mutant, std::size_t resident) const;
  /// Over 1 / N, that of a neutral mutant.
  double ratio(std::size_t mutant, std::size_t resident) const;
};

/// Of all pairs. `exact`: as fractions too; throws UsageError where the scores are not exact.
FixationProbabilities fixation_probabilities(const ScoreMatrix& scores, std::uint64_t population,
                                             const SelectionRules& rules, bool exact, unsigned threads,
                                             const Progress& progress = nullptr);

}  // namespace folk
