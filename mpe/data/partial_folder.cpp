#include <folk/games/error.h>
#include <folk/games/text_file.h>
#include <folk/mpe/data/partial_folder.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>

namespace folk::mpe {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& path, const std::string& why) {
  throw EnvironmentError(fmt::format("{}: {}", excerpt(path.string(), 1000), why));
}

/// True when the open file is still the one of this name.
bool is_at(const FileDescriptor& file, const fs::path& path) {
  struct stat opened {};
  struct stat named {};
  return ::fstat(file.get(), &opened) == 0 && ::stat(path.c_str(), &named) == 0 && opened.st_dev == named.st_dev &&
         opened.st_ino == named.st_ino;
}

/// Waits until the disk has what was written to a file or folder; false, with the reason in errno, when it failed.
/// Some file systems do not know this of folders.
bool sync(const fs::path& path) {
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  return file.get() >= 0 && (::fsync(file.get()) == 0 || errno == EINVAL);
}

/// "out/" is "out".
fs::path without_slash(const fs::path& path) { return path.has_filename() ? path : path.parent_path(); }

}  // namespace

PartialFolder::PartialFolder(const fs::path& target)
    : target_(without_slash(target)),
      path_(target_.string() + ".partial") {
  // A run that ends just now takes the folder and its lock away under our hands: the next try makes new ones.
  for (int attempt = 0; attempt < 100; ++attempt) {
    lock();
    if (!is_at(lock_, lock_path())) continue;
    remove_cut_off_writes(path_);
    return;
  }
  fail(path_, "cannot be locked: it is made and removed all the time; name another folder");
}

void PartialFolder::lock() {
  std::error_code error, ignored;
  // What is cleared must be ours: a folder that merely has this name is somebody's.
  if (fs::is_symlink(path_, ignored) ||
      (fs::is_directory(path_, ignored) && !fs::is_empty(path_, ignored) && !fs::exists(lock_path(), ignored)))
    fail(path_, "is in the way and was not begun by a run like this; move it away or name another folder");
  fs::create_directories(path_, error);
  if (!fs::is_directory(path_, ignored))
    fail(path_, fmt::format("cannot be made: {}; name another", error ? error.message() : "a file has its name"));
  lock_ = FileDescriptor(::open(lock_path().c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
  if (lock_.get() < 0 && errno == ENOENT) return;  // removed again meanwhile
  if (lock_.get() < 0) fail(path_, fmt::format("cannot be written: {}; name another", std::strerror(errno)));
  if (::flock(lock_.get(), LOCK_EX | LOCK_NB) != 0)
    fail(path_, errno == EWOULDBLOCK ? "another run is writing it; wait for its end or name another folder"
                                     : fmt::format("cannot be locked: {}; name another", std::strerror(errno)));
}

/// All that is in it but the lock.
std::vector<fs::path> PartialFolder::entries() const {
  std::vector<fs::path> found;
  std::error_code error;
  for (fs::directory_iterator entry(path_, error), end; !error && entry != end; entry.increment(error))
    if (entry->path() != lock_path()) found.push_back(entry->path());
  if (error) fail(path_, fmt::format("cannot be read: {}", error.message()));
  return found;
}

void PartialFolder::clear() {
  for (const auto& entry : entries()) {
    std::error_code error;
    fs::remove_all(entry, error);
    if (error) fail(entry, fmt::format("cannot be removed: {}", error.message()));
  }
}

void PartialFolder::remove() noexcept {
  try {
    clear();
  } catch (const Error&) {
    return;
  }
  // The lock goes last: from then on the name is free for another run, and a folder that it fills stays.
  std::error_code ignored;
  fs::remove(lock_path(), ignored);
  fs::remove(path_, ignored);
}

void PartialFolder::publish() {
  for (const auto& entry : entries())
    if (!sync(entry)) fail(entry, fmt::format("cannot be written: {}", std::strerror(errno)));
  std::error_code error;
  fs::rename(path_, target_, error);
  if (error)
    fail(target_, fmt::format("cannot be given to {}: {}; move what is there away", excerpt(path_.string(), 1000),
                              error.message()));
  std::error_code ignored;
  fs::remove(target_ / "lock", ignored);
  sync(target_);
  sync(folder_of(target_));  // which holds the name
}

}  // namespace folk::mpe
