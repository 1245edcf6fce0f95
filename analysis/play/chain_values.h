#pragma once
// What a Markov chain with payoffs is worth from each of its states on.

#include <folk/analysis/play/markov_chain.h>
#include <folk/games/criterion.h>

#include <cstddef>
#include <vector>

namespace folk {

/// Chains with more states are not solved at once.
inline constexpr std::size_t most_solved_states = 2'000;

/// What the payoff of the present round is multiplied by: 1-d for discounted, 1 for ending.
double first_weight(const Criterion& criterion);

/// The payoff from each state on under discounted or ending; `rewards` are expected payoffs of a round. `values` holds
/// a first guess and the answer. Solved at once, or by sweeps until a sweep changes nothing that counts, whichever is
/// quicker. Throws UsageError when neither is feasible.
void solve_discounted(const MarkovChain& chain, const std::vector<double>& rewards, const Criterion& criterion,
                      std::vector<double>& values);

/// One Gauss-Seidel sweep of the same; returns the largest change.
double sweep(const MarkovChain& chain, const std::vector<double>& rewards, const Criterion& criterion,
             std::vector<double>& values);

/// The long-run mean from each state on (gain), and by how much the total from there on differs from it (bias, 0 in the
/// first state of each recurrent class): Puterman (1994), Markov Decision Processes, chapter 9.
struct GainAndBias {
  std::vector<double> gain;
  std::vector<double> bias;
};

/// Throws UsageError on more than most_solved_states.
GainAndBias solve_mean(const MarkovChain& chain, const std::vector<double>& rewards);

}  // namespace folk
