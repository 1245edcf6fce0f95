#pragma once
// Ownership of an open file of the operating system, and writing all of something to it.

#include <cstddef>
#include <string_view>
#include <system_error>

namespace folk {

/// An open file descriptor that closes itself.
class FileDescriptor {
public:
  FileDescriptor() = default;
  explicit FileDescriptor(int number)
      : number_(number) {}
  FileDescriptor(FileDescriptor&& other) noexcept;
  FileDescriptor& operator=(FileDescriptor&& other) noexcept;
  ~FileDescriptor() { close(); }

  /// -1 when nothing is held.
  int get() const { return number_; }
  void close();

private:
  int number_ = -1;
};

/// A second descriptor of the same open file, close-on-exec and above 0, 1 and 2, which are free for ordinary files
/// when the host closed them. Holds nothing, with the reason in errno, when the process may open no more.
FileDescriptor duplicate_above_standard(int number);

/// Writes all bytes, where the file stands or at a place of it, however often signals interrupt. The error that stopped
/// it; std::errc::no_space_on_device where the system takes no more and gives none.
[[nodiscard]] std::error_code write_all(const FileDescriptor& file, std::string_view bytes);
[[nodiscard]] std::error_code write_all_at(const FileDescriptor& file, std::string_view bytes, std::size_t place);

}  // namespace folk
