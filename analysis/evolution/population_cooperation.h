#pragma once
// How much a population cooperates.

#include <folk/analysis/evolution/dynamics.h>
#include <folk/analysis/evolution/score_matrix.h>

#include <optional>

namespace folk {

/// The share of C in all moves when everybody plays everybody else, with K_ij the share of C of i against j:
///   sum_i n_i ((K n)_i - K_ii) / (N (N - 1))    of N individuals,
///   sum_ij p_i p_j K_ij                         of shares, or where individuals meet themselves.
/// Nothing where the moves are not known; of a single individual, what it plays against itself.
std::optional<double> population_cooperation(const ScoreMatrix& scores, const Population& population,
                                             bool meets_itself);

}  // namespace folk
