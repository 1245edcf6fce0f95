#include <folk/games/file_descriptor.h>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace folk {
namespace {

/// `write_some` writes the beginning of what it is given and returns what write(2) does.
template <class Write>
std::error_code all_written(std::string_view bytes, const Write& write_some) {
  while (!bytes.empty()) {
    const ssize_t count = write_some(bytes);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return {errno, std::generic_category()};
    if (count == 0) return std::make_error_code(std::errc::no_space_on_device);
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return {};
}

}  // namespace

FileDescriptor::FileDescriptor(FileDescriptor&& other) noexcept
    : number_(std::exchange(other.number_, -1)) {}

FileDescriptor& FileDescriptor::operator=(FileDescriptor&& other) noexcept {
  if (this != &other) {
    close();
    number_ = std::exchange(other.number_, -1);
  }
  return *this;
}

void FileDescriptor::close() {
  if (number_ >= 0) ::close(number_);
  number_ = -1;
}

FileDescriptor duplicate_above_standard(int number) {
  return FileDescriptor(::fcntl(number, F_DUPFD_CLOEXEC, STDERR_FILENO + 1));
}

std::error_code write_all(const FileDescriptor& file, std::string_view bytes) {
  return all_written(bytes, [&](std::string_view rest) { return ::write(file.get(), rest.data(), rest.size()); });
}

std::error_code write_all_at(const FileDescriptor& file, std::string_view bytes, std::size_t place) {
  const std::size_t end = place + bytes.size();
  return all_written(bytes, [&](std::string_view rest) {
    return ::pwrite(file.get(), rest.data(), rest.size(), static_cast<off_t>(end - rest.size()));
  });
}

}  // namespace folk
