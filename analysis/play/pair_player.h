#pragma once
// Chooses for each pair of a roster the most exact way to play it.

#include <folk/analysis/play/cycle_table.h>
#include <folk/analysis/play/pair_result.h>
#include <folk/analysis/play/side_by_side.h>
#include <folk/analysis/play/signature.h>
#include <folk/games/progress.h>
#include <folk/strategies/automaton.h>
#include <folk/strategies/strategy.h>

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace folk {

/// A roster made ready for play: finite machines as minimal tables, entrants that behave alike as one behaviour.
class PairPlayer {
public:
  /// `roster` must outlive this. `workers` is how many threads will call play at once.
  PairPlayer(const std::vector<Strategy>& roster, const Sampling& sampling, unsigned workers);

  /// The behaviour of each entrant.
  const std::vector<std::size_t>& behaviour_of() const { return behaviour_of_; }

  /// The first entrant of each behaviour.
  const std::vector<std::size_t>& behaviours() const { return behaviours_; }

  /// True when some pair may have to be sampled.
  bool may_sample() const { return chance_; }

  /// True for a behaviour whose players are opaque: they alone may hold beliefs.
  bool is_opaque(std::size_t behaviour) const { return !strategy(behaviour).machine; }

  /// The pair of two behaviours: by cycles where both are deterministic machines and nothing slips, by a single match
  /// where both are deterministic and one is opaque, else by their Markov chain where both are finite machines (or the
  /// rounds that count are finite) and it is small enough, else by sampling.
  /// Throws UsageError with both names where none of these can be had.
  PairResult play(std::size_t a, std::size_t b, unsigned worker);

  /// True for a pair of which somebody thinks together with other players: its place is in play_together.
  bool thinks_together(std::size_t a, std::size_t b) const {
    return prepared_[a].thinks_together || prepared_[b].thinks_together;
  }

  /// Pairs that think together, all at once, with the sampling's threads; results in the same order.
  std::vector<PairResult> play_together(const std::vector<std::pair<std::size_t, std::size_t>>& pairs,
                                        const Progress& progress) const;

  /// Adds what is known of each entrant's play: its name, its behaviour, and the behaviours' automata.
  void sign(Signature& signature) const;

private:
  struct Prepared {
    bool deterministic = false;
    bool thinks_together = false;
    std::optional<Automaton> automaton;
    std::optional<CycleTable> cycles;
  };

  const Strategy& strategy(std::size_t behaviour) const { return roster_[behaviours_[behaviour]]; }
  Contest contest(std::size_t a, std::size_t b) const;
  Prepared prepare(const Strategy& strategy) const;
  void unroll_into(Prepared& prepared, const Machine& machine) const;
  PairResult play_best(std::size_t a, std::size_t b, unsigned worker);

  const std::vector<Strategy>& roster_;
  Sampling sampling_;
  Sense sense_;
  bool chance_ = false;             // something mixes or slips, so that Markov chains are needed
  std::vector<Prepared> prepared_;  // by behaviour
  std::vector<std::size_t> behaviour_of_;
  std::vector<std::size_t> behaviours_;
  std::vector<CycleFinder> finders_;  // one a worker
};

/// One pair, by the most exact way there is.
PairResult play_pair(const Strategy& first, const Strategy& second, const Sampling& sampling = {});

}  // namespace folk
