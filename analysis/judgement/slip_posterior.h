#pragma once
// Bayes' rule over who played and how often its moves slip.

#include <cstddef>
#include <vector>

namespace folk {

/// P(candidate, slip rate | what was played), by its two margins.
struct SlipPosterior {
  std::vector<double> candidates;           ///< add up to 1; all 0 where nothing played is possible
  std::vector<double> slips;                ///< the same of the slip rates
  std::vector<std::size_t> likeliest_slip;  ///< of each candidate, the slip rate that goes with it best
  double log_evidence = 0;                  ///< ln P(what was played); minus infinity where it is impossible

  bool possible() const;

  /// The likeliest candidate; the first of several.
  std::size_t likeliest() const;
};

/// `log_likelihoods[c][s]`: ln P(what was played | candidate c, slip rate s), minus infinity allowed. Candidate and
/// slip rate are independent before: candidates by their weights (above 0, in any unit), slip rates each alike.
/// Throws UsageError where there is nobody or no slip rate.
SlipPosterior slip_posterior(const std::vector<double>& weights,
                             const std::vector<std::vector<double>>& log_likelihoods);

/// The slip rates that are weighed where no others are given.
std::vector<double> usual_slips();

/// Throws UsageError for no slip rates, one outside [0, 0.5), and one that is there twice: at 0.5 a move says nothing
/// about who made it, and above it everybody plays as another's opposite.
void check_slips(const std::vector<double>& slips);

}  // namespace folk
