#pragma once
// Do two machines behave alike? Proved by walking their product, or refuted by the shortest play that separates them.

#include <folk/games/outcome.h>
#include <folk/strategies/automaton.h>
#include <folk/strategies/machine.h>

#include <cstddef>
#include <vector>

namespace folk {

/// What `compare` found.
enum class Equivalence {
  equivalent,  ///< proved: no play of any length separates the two
  different,   ///< `play` separates them
  undecided    ///< no play of up to `depth` rounds separates them; longer ones were not tried
};

struct Comparison {
  Equivalence equivalence = Equivalence::undecided;
  std::size_t pairs = 0;      ///< joint states that were reached
  std::size_t depth = 0;      ///< every play of up to this many rounds was tried (different: the length of `play`)
  std::vector<Outcome> play;  ///< when different: a shortest play, as they see it, after which they answer differently
  double first = 0;           ///< when different: P(C) of the first machine after `play`
  double second = 0;          ///< and of the second
};

/// Compares how two machines answer to everything that can happen to them.
///
/// In the sense own_moves_its_own the own move of a round is one that both machines play with a positive probability
/// (they agree on it up to there); in any_own_moves it is either move. A machine is a deterministic function of the
/// observed rounds, so the walk is exact for machines that mix too: those differ when their P(C) differ. Rounds are
/// tried in the order CC, CD, DC, DD (own move first), breadth first, so that `play` is the first of the shortest.
/// Machines without end are walked until `most_pairs` joint states are known.
Comparison compare(const Machine& a, const Machine& b, Sense sense, std::size_t most_pairs = 1'000'000);

}  // namespace folk
