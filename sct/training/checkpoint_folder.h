#pragma once
// The folder in which a run of sct-train keeps its last checkpoints.

#include <folk/sct/files/checkpoint_files.h>
#include <folk/sct/training/checkpoint.h>

#include <functional>
#include <optional>
#include <string>

namespace folk::sct {

/// CheckpointFiles that hold Checkpoints.
class CheckpointFolder : public CheckpointFiles {
public:
  using CheckpointFiles::CheckpointFiles;

  /// The newest one that can be read; nothing when there is none at all. `skipped` is told why each newer one cannot.
  /// Throws InputFileError, of the newest, when none can.
  std::optional<Checkpoint> newest(const std::function<void(const std::string&)>& skipped) const;

  /// Throws EnvironmentError, and what checkpoint_bytes throws; the older ones then stay.
  void write(const Checkpoint& checkpoint);
};

}  // namespace folk::sct
