#pragma once
// What a path pays its first player, exactly.

#include <folk/analysis/play/play_path.h>
#include <folk/analysis/replies/flow.h>
#include <folk/games/outcome.h>

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace folk {

/// The payoffs of a path from each of its rounds on, in the criterion's unit. What follows a path that was cut is taken
/// to pay the largest payoff of the game in every round: gains over it are never overstated.
class PathPayoffs {
public:
  /// Throws UsageError when payoffs are too large or too long to add up exactly, std::logic_error when the path does
  /// not fit the criterion or is empty.
  PathPayoffs(const PlayPath& path, const Payoffs& payoffs, const Criterion& criterion);

  std::size_t rounds() const { return rounds_.size(); }

  /// Of the whole path.
  Rational total() const { return from(0); }

  /// From round t (0 is the first) on, as seen from there.
  Rational from(std::size_t round) const;
  double rounded_from(std::size_t round) const;

  /// What is gained, as seen from the path's start, by playing the other move in round t and being paid `rate` a round
  /// from then on.
  Rational gain(std::size_t round, const Rational& rate) const;
  /// The same rounded, as seen from that round: times weight(round) it is the gain from the start.
  double rounded_gain(std::size_t round, double rate) const;

  /// What a payoff of round t counts at the start: continuation^t, 1 for finite and mean.
  double weight(std::size_t round) const;

  /// By how much a rounded payoff or gain may be wrong.
  double doubt() const { return doubt_; }

private:
  Criterion criterion_;
  std::array<Rational, 4> payoffs_;
  std::array<double, 4> numbers_;
  std::vector<Outcome> rounds_;
  std::vector<double> tails_;  // finite: whole totals from each round on
  double scale_ = 1;
  Rational exact_scale_ = 1;
  std::optional<Flow> flow_;  // without end
  double doubt_ = 0;
};

}  // namespace folk
