#pragma once
// What is told of a finished training run.

#include <folk/tools/sct_train/config.h>

#include <folk/sct/policy/belief_effect.h>
#include <folk/sct/policy/roster_play.h>
#include <folk/sct/training/selection.h>
#include <folk/strategies/strategy.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace folk::tools {

/// One policy: how it was trained, how it fared, where it lies.
struct TrainReport {
  TrainConfig config;
  std::size_t lessons = 0;  ///< matches of the data
  std::size_t added = 0;    ///< matches of the learner itself that a teacher labelled
  std::vector<sct::Evaluation> history;
  std::size_t kept = 0;        ///< index in the history
  bool stopped_early = false;  ///< for want of patience
  std::vector<Strategy> roster;
  sct::RosterScore clean;  ///< the kept policy against each of the roster, nobody's moves flipping
  std::vector<Strategy> held_out;
  std::optional<sct::RosterScore> clean_held_out;  ///< likewise against those held out
  sct::BeliefEffect effect;                        ///< of its belief token on its moves against the roster
  std::string output;                              ///< the policy's file
};

}  // namespace folk::tools
