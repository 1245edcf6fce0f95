#pragma once
// The folder in which something is made before it gets its name: DIR.partial, which becomes DIR when all is there.

#include <folk/games/file_descriptor.h>

#include <filesystem>
#include <vector>

namespace folk::mpe {

/// Holds the folder's lock for as long as it lives: two runs with one name would write over each other. The lock falls
/// with the process, however that ends.
class PartialFolder {
public:
  /// Makes `target`.partial if need be, and the folders above it; removes what a write of an earlier run left that was
  /// cut off. Throws EnvironmentError when it cannot be made or
  /// written, or when another process holds its lock.
  explicit PartialFolder(const std::filesystem::path& target);

  const std::filesystem::path& path() const { return path_; }

  /// Removes what an earlier run left in it. Throws EnvironmentError when that cannot be done.
  void clear();

  /// Removes the folder and all that is in it, as far as that can be done.
  void remove() noexcept;

  /// Waits until the disk has its files, then gives it its name. Throws EnvironmentError when that cannot be done.
  void publish();

private:
  void lock();
  std::vector<std::filesystem::path> entries() const;
  std::filesystem::path lock_path() const { return path_ / "lock"; }

  std::filesystem::path target_;
  std::filesystem::path path_;
  FileDescriptor lock_;
};

}  // namespace folk::mpe
