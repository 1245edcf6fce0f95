#pragma once
// A training run as its config describes it, ready for its first step.

#include <folk/tools/program/program.h>
#include <folk/tools/sct_train/config.h>

#include <folk/sct/training/training_run.h>

#include <cstddef>
#include <vector>

namespace folk::tools {

struct BegunRun {
  std::vector<Strategy> roster;
  sct::RunSettings plan;
  sct::TrainingSettings training;
  std::size_t lessons = 0;  ///< matches of the data; none where it explores
  sct::TrainingRun run;
};

/// Reads or plays the data, by which the config is settled. Throws UsageError, and what reading a folder throws.
BegunRun begin_run(TrainConfig& config, unsigned threads, const Common& common);

/// The policy that the run keeps, with the names of the config's actions.
sct::Policy finished_policy(const BegunRun& begun, const TrainConfig& config);

}  // namespace folk::tools
