#pragma once
// What two strategies play when nothing happens by chance: some rounds, and perhaps a cycle at their end.

#include <folk/games/criterion.h>
#include <folk/games/outcome.h>
#include <folk/games/payoffs.h>
#include <folk/strategies/machine.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace folk {

/// The path of a pair.
struct PlayPath {
  std::vector<Outcome> rounds;       ///< as the first player sees them
  std::optional<std::size_t> cycle;  ///< after the last round play goes on here; nothing: it ends, or is cut
  bool cut = false;                  ///< play goes on, but how is not known

  /// The same path as the second player sees it.
  PlayPath exchanged() const;
};

/// Paths of more rounds are not written out.
inline constexpr std::size_t most_path_rounds = 1'000'000;

/// The path of two deterministic machines: all T rounds under finite:T, else up to the first repeated pair of states. A
/// pair that has not repeated after `horizon` rounds (0: most_path_rounds) is cut there.
/// Throws UsageError under finite:T with T > most_path_rounds, std::logic_error for a machine that mixes.
PlayPath play_path(const Machine& first, const Machine& second, const Criterion& criterion, std::size_t horizon = 0);

}  // namespace folk
