#pragma once
// A file's bytes as memory, read from the disk as they are looked at.

#include <cstddef>
#include <filesystem>
#include <string_view>

namespace folk::mpe {

/// The file is not to be cut off while it is mapped: looking at bytes that are gone ends the process (SIGBUS).
class MappedFile {
public:
  /// Throws InputFileError when it is no ordinary file or cannot be read.
  explicit MappedFile(const std::filesystem::path& path);
  MappedFile(MappedFile&& other) noexcept;
  MappedFile& operator=(MappedFile&& other) noexcept;
  ~MappedFile();

  std::string_view bytes() const { return bytes_; }

private:
  std::string_view bytes_;
};

}  // namespace folk::mpe
