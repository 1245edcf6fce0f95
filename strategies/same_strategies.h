#pragma once
// Which strategies of a list are one strategy under several names?

#include <folk/strategies/automaton.h>
#include <folk/strategies/strategy.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace folk {

/// Places in the list, ascending.
struct SameStrategies {
  std::vector<std::vector<std::size_t>> groups;                ///< each proved to be one; groups of one are left out
  std::vector<std::pair<std::size_t, std::size_t>> undecided;  ///< no play of those tried separates the two
  std::vector<std::size_t> opaque;                             ///< players, of whom nothing can be proved
};

/// Compares the machines among `strategies` as `compare` does, each with one of every group so far, and those that it
/// leaves undecided on long runs of one move, then the other.
SameStrategies same_strategies(const std::vector<Strategy>& strategies, Sense sense, std::size_t most_pairs = 100'000);

}  // namespace folk
