#pragma once
// A folder that is made for what will be written, and is gone again when nothing was.

#include <filesystem>
#include <system_error>
#include <vector>

namespace folk::sct {

/// Makes a folder and those that it lies in. When it goes, the empty ones of those that it made are removed.
class MadeFolder {
public:
  /// `error` says why the folder cannot be made; nothing is thrown.
  MadeFolder(const std::filesystem::path& folder, std::error_code& error);
  ~MadeFolder();
  MadeFolder(const MadeFolder&) = delete;
  MadeFolder& operator=(const MadeFolder&) = delete;

  /// False when the folder was there before.
  bool made() const { return !made_.empty(); }

private:
  std::vector<std::filesystem::path> made_;  // the innermost first
};

}  // namespace folk::sct
