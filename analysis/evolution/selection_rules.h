#pragma once
// How payoffs become success in a finite population: birth-death (Moran) and pairwise comparison, with an intensity of
// selection.

#include <folk/games/rational.h>

#include <string>

namespace folk {

/// Who replaces whom.
enum class Process {
  birth_death,  ///< one is born, drawn by fitness, and replaces one drawn at random (Moran 1958; Nowak et al. 2004)
  pairwise_comparison  ///< of two drawn at random the first takes over the second's strategy with the Fermi function of
                       ///< their payoffs (Blume 1993; Szabó & Tőke 1998; Traulsen, Nowak & Pacheco 2006)
};

/// The fitness of who earns pi in birth-death, w being the intensity.
enum class Fitness {
  linear,      ///< 1 - w + w pi, 0 <= w <= 1 (Nowak, Sasaki, Taylor & Fudenberg 2004)
  exponential  ///< exp(w pi) (Traulsen, Shoresh & Nowak 2008)
};

/// Payoffs are payoffs a round, the mean over all partners: of n individuals of N
///   pi_i = (sum_j n_j a_ij - a_ii) / (N - 1), or (meets_itself) sum_j n_j a_ij / N.
/// Pairwise comparison: probability 1 / (1 + exp(-w (pi_model - pi_own))), w >= 0.
struct SelectionRules {
  Process process = Process::birth_death;
  Fitness fitness = Fitness::linear;
  Rational intensity = 1;  ///< w
  bool meets_itself = false;

  /// "birth-death, fitness 1 - w + w payoff, w 0.1".
  std::string text() const;
};

/// Throws UsageError when the intensity is out of the range of its process.
void check(const SelectionRules& rules);

}  // namespace folk
