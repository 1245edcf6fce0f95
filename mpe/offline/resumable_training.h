#pragma once
// An offline training run with a folder in which it keeps itself.

#include <folk/games/progress.h>
#include <folk/mpe/offline/offline_training.h>
#include <folk/sct/files/checkpoint_files.h>

#include <cstdint>
#include <functional>
#include <string>

namespace folk::mpe {

/// How a run is watched over.
struct TrainingWatch {
  sct::CheckpointFiles* folder = nullptr;                  ///< where it is kept; nowhere
  std::uint64_t checkpoint_every = 1000;                   ///< steps
  std::function<void(const std::string&)> note = nullptr;  ///< told of checkpoints that could not be read
};

/// Goes on from the newest checkpoint in the folder. False when there is none. Throws what OfflineTraining::restore
/// does.
bool resume(OfflineTraining& training, const TrainingWatch& watch);

/// Trains to the end. `progress` is told the share of this run's steps that is done, and may end the work between any
/// two; the folder then has the run as it stands, as it does at the end. Throws Cancelled, what `progress` throws, and
/// what OfflineTraining::step does.
void train(OfflineTraining& training, const TrainingWatch& watch, const Progress& progress = nullptr);

}  // namespace folk::mpe
