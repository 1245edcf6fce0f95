#pragma once
// How often a population is of each strategy in the long run when mutations are rare.

#include <folk/analysis/evolution/fixation.h>

#include <vector>

namespace folk {

/// When mutants fix or are lost before the next one comes, the population is almost always of one strategy, and goes
/// from strategy i to j with probability rho_ij / (k - 1): the stationary distribution of that embedded chain
/// (Fudenberg & Imhof, J. Econ. Theory 131, 2006; Imhof, Fudenberg & Nowak, PNAS 102, 2005), by the elimination of
/// Grassmann, Taksar & Heyman, which does not subtract. Strategies that the chain leaves for ever have 0.
/// Throws UndecidedError where where it ends depends on where it begins.
std::vector<double> small_mutation_distribution(const FixationProbabilities& fixation,
                                                const Progress& progress = nullptr);

/// The same in fractions, which grow with the size of the population and the square of the number of strategies. Throws
/// UsageError where `fixation` holds none.
std::vector<Rational> exact_small_mutation_distribution(const FixationProbabilities& fixation,
                                                        const Progress& progress = nullptr);

/// sum_i p_i rho_ij - p_j sum_i rho_ji: 0 of a stationary distribution.
std::vector<Rational> stationarity_residual(const FixationProbabilities& fixation,
                                            const std::vector<Rational>& distribution);

}  // namespace folk
