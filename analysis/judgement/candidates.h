#pragma once
// Who may have played what was recorded.

#include <folk/analysis/replies/opponent_prior.h>
#include <folk/strategies/strategy.h>

#include <cstdint>
#include <string>
#include <vector>

namespace folk {

/// The strategies of a prior, those that answer alike as one, and its complete classes.
struct Candidates {
  /// Strategies that no play of `rounds` rounds tells apart, not one in which moves slip either.
  struct Behaviour {
    std::vector<Strategy> strategies;  ///< in the order of the prior; the first stands for all
    double weight = 0;                 ///< of all of them together

    const Strategy& first() const { return strategies.front(); }

    /// "tit_for_tat = mem11_cCDCD".
    std::string names() const;
  };

  std::vector<Behaviour> behaviours;
  std::vector<OpponentPrior::Class> classes;

  /// The weights of the behaviours, then those of the classes.
  std::vector<double> weights() const;
};

/// Finite machines are compared whole, others as far as matches of `rounds` rounds go (where they reach too many states
/// in these, each is taken to be one of its own, as opaque players are).
Candidates candidates_of(const OpponentPrior& prior, std::uint64_t rounds);

/// Removes the players that draw random numbers and are no machines, as nobody knows how likely their moves are.
/// Returns their names.
std::vector<std::string> leave_out_unpredictable(OpponentPrior& prior);

}  // namespace folk
