#pragma once
// How a policy fares against a roster: what training is judged by.

#include <folk/analysis/play/sampled_play.h>
#include <folk/games/progress.h>
#include <folk/strategies/strategy.h>

#include <optional>
#include <vector>

namespace folk::sct {

/// A strategy's matches against each of a roster.
struct RosterScore {
  std::vector<double> scores;             ///< against each
  double total = 0;                       ///< their sum
  std::optional<double> belief_accuracy;  ///< share of right guesses, over all matches
};

/// Each strategy against each of the roster; all matches are played side by side.
std::vector<RosterScore> play_roster(const std::vector<Strategy>& strategies, const std::vector<Strategy>& roster,
                                     const Sampling& sampling, const Progress& progress = nullptr);

}  // namespace folk::sct
