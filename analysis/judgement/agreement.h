#pragma once
// How what was played agrees with a strategy: which of the moves it could have made, and how likely all of them are
// when moves slip.

#include <folk/analysis/judgement/recorded_play.h>
#include <folk/games/payoffs.h>
#include <folk/games/seat.h>
#include <folk/strategies/strategy.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

namespace folk {

/// A round of a record, both counted from 0.
struct RecordedPlace {
  std::size_t match = 0;
  std::size_t round = 0;
};

/// The probabilities that a strategy gives the moves of one side, without slips, each after what was really played
/// before: in which order they come says nothing of its likelihood.
class Agreement {
public:
  /// The strategy made this move with probability `chance`.
  void add(double chance, RecordedPlace place);

  /// It could have made every move.
  bool consistent() const { return !first_impossible_; }

  /// It could have made no other move.
  bool certain() const;

  std::uint64_t rounds() const { return rounds_; }

  /// Moves that it never makes there: without slips it did not play this.
  std::uint64_t impossible() const;
  const std::optional<RecordedPlace>& first_impossible() const { return first_impossible_; }

  /// ln P(the moves) when each slips with probability `slip`, independently; minus infinity where it is 0.
  double log_likelihood(double slip) const;

private:
  std::map<double, std::uint64_t> rounds_by_chance_;
  std::uint64_t rounds_ = 0;
  std::optional<RecordedPlace> first_impossible_;
};

/// The P(C) of a strategy in each round of a match, told what was really played before it: a slip moves its state as
/// any other move does. Throws UsageError for an opaque player that draws random numbers, and what players throw.
std::vector<double> cooperation_along(const Strategy& strategy, const BeliefMatch& match, Seat seat,
                                      const Payoffs& payoffs);

/// The agreement of the moves in `seat` of all these matches. Throws as cooperation_along does.
Agreement agreement_with(const Strategy& strategy, std::span<const RecordedMatch> matches, Seat seat,
                         const Payoffs& payoffs);

}  // namespace folk
