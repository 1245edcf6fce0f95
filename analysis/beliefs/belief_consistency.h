#pragma once
// Are the beliefs that a policy holds on its path true? Distances, scores, calibration and the rounds that went wrong.

#include <folk/analysis/beliefs/belief_record.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace folk {

/// The rounds in which a belief P(C) fell into one tenth of [0, 1] (the last tenth holds 1).
struct CalibrationBin {
  std::uint64_t count = 0;
  double belief_sum = 0;
  std::uint64_t cooperations = 0;  ///< rounds in which C was played

  /// Nothing for an empty bin.
  std::optional<double> mean_belief() const;
  std::optional<double> frequency() const;
};

/// How far the beliefs of some matches are from what the opponent does.
///
/// Beliefs are consistent (Fudenberg & Levine 1993; the self-confirming transformer's paper, its equation for the
/// belief) when on every information state that occurs with positive probability the predicted distribution over the
/// opponent's action equals the opponent's own. With two actions the total variation distance of the two is
/// |belief - truth|, both P(C); beliefs are consistent up to epsilon when `largest_distance` <= epsilon. For a pair
/// that is deterministic the one match is that path; sampled matches are a part of it, and the figures are estimates.
///
/// Accuracy, log loss and Brier score are against the moves that were played, as a forecaster is scored.
struct BeliefConsistency {
  std::uint64_t matches = 0;
  std::uint64_t rounds = 0;     ///< with a belief; all figures are over these
  double largest_distance = 0;  ///< sup of the total variation distance over the rounds
  double distance_sum = 0;
  std::uint64_t right = 0;  ///< rounds in which the likelier move (C at even odds) was played
  double log_loss_sum = 0;  ///< - sum of ln(probability that was given to the move played); infinite after a surprise
  std::uint64_t surprises = 0;  ///< rounds in which a move was played that had been given probability 0
  double brier_sum = 0;         ///< sum of (belief - [C was played])^2
  std::array<CalibrationBin, 10> bins{};
  std::vector<std::uint64_t> wrong_rounds{};  ///< 1-based, ascending: the likelier move was wrong in some match
  std::uint64_t first_round = 0;              ///< the first round with a belief in any match, 1-based; 0: none
  bool last_wrong = false;                    ///< the last belief of some match was wrong

  // Nothing without a belief.
  std::optional<double> mean_distance() const;
  std::optional<double> accuracy() const;
  /// Mean natural log loss. Nothing is clipped: infinite when there was a surprise.
  std::optional<double> log_loss() const;
  std::optional<double> brier() const;

  /// The first round (1-based) from which all beliefs are right, in every match; nothing when a match ends with a wrong
  /// one or there are no beliefs.
  std::optional<std::uint64_t> settled_from() const;

  /// Adds a match. Throws std::logic_error on a belief outside [0, 1] (NaN included).
  void add(const BeliefMatch& match);

  /// All of both, as for an overall figure: sums add up, a round is wrong when it is in either.
  BeliefConsistency& operator+=(const BeliefConsistency& more);
};

/// Of all matches of a record.
BeliefConsistency belief_consistency(const BeliefRecord& record);

}  // namespace folk
