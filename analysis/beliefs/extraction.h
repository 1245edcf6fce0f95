#pragma once
// An automaton that behaves as an opaque deterministic policy does, and how faithfully.

#include <folk/analysis/beliefs/belief_record.h>
#include <folk/games/payoffs.h>
#include <folk/games/progress.h>
#include <folk/strategies/automaton.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace folk {

/// How an automaton plays beside the policy in the policy's matches against one opponent.
struct MatchFidelity {
  std::string opponent;
  std::uint64_t moves = 0;
  std::uint64_t equal_told = 0;  ///< own moves that are the policy's when the automaton is told the policy's match
  /// Own moves that are the policy's when the automaton plays the opponent itself; nothing where that draws random
  /// numbers.
  std::optional<std::uint64_t> equal_played{};
  /// The first round (1-based) in which the automaton told the match moves otherwise; also the first one played
  /// otherwise, since up to then both are the same match. Nothing when all are equal. Of several matches the earliest.
  std::optional<std::uint64_t> first_difference{};
};

/// All of these matches.
struct Fidelity {
  std::vector<MatchFidelity> matches;

  std::uint64_t moves() const;

  // Shares of equal moves, 1 when there are none.
  double told() const;
  /// Over all opponents that draw no random numbers; nothing when there is none.
  std::optional<double> played() const;
};

/// `records` are the policy's against `opponents` (record_beliefs); they may be those that the automaton was built from
/// or others that it was not.
Fidelity fidelity(const Automaton& automaton, const std::vector<Strategy>& opponents,
                  const std::vector<BeliefRecord>& records, const Payoffs& payoffs = {});

/// From what and how an automaton is made.
struct ExtractionOptions {
  Payoffs payoffs;
  unsigned depth = 10;  ///< all moves of an opponent in the first `depth` rounds, at most 16; 0: matches alone
  std::uint64_t ignored_last = 0;  ///< last rounds of the matches that are not built from: a policy may count rounds
  std::vector<double> state_prices{0, 1, 2, 4, 8, 12, 16, 24, 32, 64};  ///< an automaton each
  unsigned threads = 1;
};

/// An automaton made at one price of states.
struct Extraction {
  Automaton machine;             ///< minimal in the sense own_moves_its_own
  double state_price = 0;        ///< a state was made where it saves more than this many moves
  std::uint64_t built_from = 0;  ///< moves in all it was built from: one each round of a match, one each other history
  std::uint64_t wrong = 0;       ///< of these it moves otherwise
  std::size_t unseen = 0;        ///< successors that nothing tells of: there a state stays as it is
  Fidelity matches{};            ///< on the matches it was built from, ignored rounds included
};

/// Automata of a policy, from its records against `opponents` and from what it moves after all 2^h sequences of the
/// opponent's moves, h = 0 .. depth, its own moves being its own (such histories weigh one move). They come by merging
/// the states of the prefix tree of all that (merge_states), one automaton a price, in the order of the prices. The
/// policy knows the round and all that was played; a finite automaton need not be able to do as it does, and what each
/// price costs in moves is what these figures show.
///
/// Throws UsageError when the policy draws random numbers, records and opponents do not belong together, the depth
/// passes 16 or the length of the matches, or nothing is left to build from, Cancelled, and what the players throw. The
/// result depends on no number of threads.
std::vector<Extraction> extract_machines(const Strategy& policy, const std::vector<Strategy>& opponents,
                                         const std::vector<BeliefRecord>& records, const ExtractionOptions& options,
                                         const Progress& progress = nullptr);

/// The one to draw: of those with at most `most_states` states that which plays the matches most faithfully (told when
/// none can be played), then the one with the fewest wrong moves, then the smallest, then the first. When none of them
/// plays `aim` of the moves, the limit is doubled once. Nothing when all are larger. Its place in `extractions`.
std::optional<std::size_t> readable_machine(const std::vector<Extraction>& extractions, std::size_t most_states = 16,
                                            double aim = 0.99);

}  // namespace folk
