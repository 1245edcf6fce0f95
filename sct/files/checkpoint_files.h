#pragma once
// A folder in which a training run keeps its last checkpoints, whatever they hold: DIR/step-1000.checkpoint.

#include <folk/games/file_descriptor.h>
#include <folk/sct/files/made_folder.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace folk::sct {

/// No checkpoint that Folk reads is larger than this.
inline constexpr std::size_t largest_checkpoint = std::size_t{4} << 30U;

/// Holds the folder's lock for as long as it lives: two runs in one folder would take each other's checkpoints away.
/// The lock falls with the process, however that ends. A folder that it made and wrote no checkpoint into is gone with
/// it.
class CheckpointFiles {
public:
  /// How many checkpoints are kept.
  static constexpr std::size_t kept = 2;

  /// Makes the folder if need be and removes what an interrupted write left in it. Throws EnvironmentError when it
  /// cannot be made or written, or when another process holds its lock.
  explicit CheckpointFiles(std::filesystem::path path);
  ~CheckpointFiles();
  CheckpointFiles(const CheckpointFiles&) = delete;
  CheckpointFiles& operator=(const CheckpointFiles&) = delete;

  /// The checkpoints by step.
  std::vector<std::filesystem::path> checkpoints() const;

  /// Hands the newest file to `parse` that takes it without an InputFileError: (bytes, path). False when there is none
  /// at all. `skipped` is told why each newer one cannot be read. Throws the newest one's InputFileError when none can.
  bool read_newest(const std::function<void(std::string_view, const std::string&)>& parse,
                   const std::function<void(const std::string&)>& skipped) const;

  /// Writes a checkpoint at once or not at all, then removes all but the last `kept`. Throws EnvironmentError; the
  /// older ones then stay.
  void write_bytes(std::uint64_t step, std::string_view bytes);

  const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
  std::optional<MadeFolder> folder_;
  FileDescriptor lock_;
};

}  // namespace folk::sct
