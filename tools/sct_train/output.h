#pragma once
// A finished training run as text, CSV and JSON.

#include <folk/tools/sct_train/config.h>

#include <folk/sct/policy/belief_effect.h>
#include <folk/sct/policy/roster_play.h>
#include <folk/sct/training/training_run.h>
#include <folk/strategies/strategy.h>

#include <ostream>
#include <string>
#include <vector>

namespace folk::tools {

/// What is told of a run.
struct TrainReport {
  TrainConfig config;
  std::size_t lessons = 0;  ///< matches of the data
  std::size_t added = 0;    ///< matches of the learner itself that a teacher labelled
  std::vector<sct::Evaluation> history;
  std::size_t kept = 0;  ///< index in the history
  std::vector<Strategy> roster;
  sct::RosterScore clean;    ///< the kept policy against each of the roster, nobody's moves flipping
  sct::BeliefEffect effect;  ///< of its belief token on its moves in these matches
  std::string output;        ///< the policy's file
};

/// Settings, the evaluations as a table, the kept policy against each opponent.
void write_text(std::ostream& out, const TrainReport& report);

/// A line an evaluation.
void write_csv(std::ostream& out, const TrainReport& report);

/// One object; docs/sct-train.md says what it holds.
void write_json(std::ostream& out, const TrainReport& report);

}  // namespace folk::tools
