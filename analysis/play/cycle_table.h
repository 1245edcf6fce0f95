#pragma once
// The fast path of a tournament: two small deterministic automata, their cycle found and counted in nanoseconds.

#include <folk/analysis/play/pair_result.h>
#include <folk/games/criterion.h>
#include <folk/strategies/automaton.h>

#include <cstdint>
#include <limits>
#include <vector>

namespace folk {

/// A deterministic automaton with its move in the lowest bit of each state, so that one look-up gives both.
class CycleTable {
public:
  /// Throws std::logic_error when the automaton mixes.
  explicit CycleTable(const Automaton& automaton);

  std::uint32_t start() const { return start_; }
  std::size_t size() const { return next_.size() / 2; }

  /// The state (number and own move) after their move, the own move being the machine's own.
  std::uint32_t next(std::uint32_t state, std::uint32_t theirs) const { return next_[(state & ~1U) | (theirs & 1U)]; }

private:
  std::vector<std::uint32_t> next_;
  std::uint32_t start_;
};

/// Finds the cycle of a pair: room for its marks is kept from one pair to the next, one CycleFinder a thread.
class CycleFinder {
public:
  /// Pairs with more joint states do not fit.
  static constexpr std::size_t most_joint_states = 65'535;

  /// Marks from here on could overflow within a pair: the finder then wipes them and begins anew. (A tournament gets
  /// here after some 10^8 pairs.)
  static constexpr std::uint32_t last_epoch = std::numeric_limits<std::uint32_t>::max() - 2 * most_joint_states;

  CycleFinder() = default;

  /// One whose marks begin at `first_epoch`, at least 1, as if it had played before: for tests.
  explicit CycleFinder(std::uint32_t first_epoch)
      : epoch_(first_epoch) {}

  static bool fits(const CycleTable& first, const CycleTable& second) {
    return first.size() * second.size() <= most_joint_states;
  }

  /// The exact outcome weights of the pair under any criterion. The pair must fit.
  PairResult play(const CycleTable& first, const CycleTable& second, const Criterion& criterion);

private:
  void walk(const CycleTable& first, const CycleTable& second, std::uint64_t rounds);
  OutcomeWeights sum_finite(std::uint64_t rounds) const;
  OutcomeWeights sum_geometric(const Criterion& criterion) const;
  OutcomeWeights mean_of_cycle() const;

  // marks_[joint state] = epoch_ + the round in which this pair stood there; lower values are of earlier pairs.
  std::vector<std::uint32_t> marks_;
  std::uint32_t epoch_ = 1;
  // counts_[t]: the outcomes of rounds before t, four 16-bit counts in a word.
  std::vector<std::uint64_t> counts_;
  std::size_t cycle_begin_ = 0;
  std::size_t cycle_end_ = 0;
};

}  // namespace folk
