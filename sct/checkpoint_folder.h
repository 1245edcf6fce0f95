#pragma once
// The folder in which a training run keeps its last checkpoints.

#include <folk/sct/checkpoint.h>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace folk::sct {

/// Holds the folder's lock for as long as it lives: two runs in one folder would take each other's checkpoints away.
/// The lock falls with the process, however that ends.
class CheckpointFolder {
public:
  /// How many checkpoints are kept.
  static constexpr std::size_t kept = 2;

  /// Makes the folder if need be and removes what an interrupted write left in it. Throws EnvironmentError when it
  /// cannot be made or written, or when another process holds its lock.
  explicit CheckpointFolder(std::filesystem::path path);
  ~CheckpointFolder();
  CheckpointFolder(const CheckpointFolder&) = delete;
  CheckpointFolder& operator=(const CheckpointFolder&) = delete;

  /// The checkpoints by step: DIR/step-1000.checkpoint.
  std::vector<std::filesystem::path> checkpoints() const;

  /// The newest one that can be read; nothing when there is none at all. `skipped` is told why each newer one cannot.
  /// Throws InputFileError, of the newest, when none can.
  std::optional<Checkpoint> newest(const std::function<void(const std::string&)>& skipped) const;

  /// Writes a checkpoint at once or not at all, then removes all but the last `kept`. Throws EnvironmentError, and what
  /// checkpoint_bytes throws; the older ones then stay.
  void write(const Checkpoint& checkpoint);

  const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
  int lock_ = -1;
};

}  // namespace folk::sct
