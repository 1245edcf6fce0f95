#pragma once
// Markov chains with at most four successors a state, as two machines or a machine and its reply make them.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace folk {

/// What happens in a state, and where each of the four outcomes leads.
struct ChainState {
  std::array<double, 4> probability{};
  std::array<std::uint32_t, 4> next{};
};

/// States by number.
using MarkovChain = std::vector<ChainState>;

/// The communicating classes of a chain; play ends in one of the recurrent ones.
struct ChainClasses {
  std::vector<std::size_t> of;                    ///< each state's class
  std::vector<std::vector<std::size_t>> members;  ///< of each class, in ascending order
  std::vector<bool> recurrent;                    ///< a class that is never left
};

ChainClasses classes_of(const MarkovChain& chain);

}  // namespace folk
