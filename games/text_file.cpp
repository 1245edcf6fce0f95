#include <folk/games/error.h>
#include <folk/games/file_descriptor.h>
#include <folk/games/text_file.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>
#include <vector>

namespace folk {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view temporary_begin = ".folk-";
constexpr std::string_view temporary_end = ".tmp";

std::string reason(int error) { return std::generic_category().message(error); }

[[noreturn]] void fail(const fs::path& path, const std::string& why) {
  throw EnvironmentError(fmt::format("{}: cannot be written: {}", excerpt(path.string(), 1000), why));
}

/// Where a write to `path` ends up: a symbolic link stays one, and the file it names is made or replaced.
fs::path behind_links(fs::path path) {
  std::error_code error;
  for (int links = 0; links < 40 && fs::is_symlink(fs::symlink_status(path, error)); ++links) {
    const fs::path next = fs::read_symlink(path, error);
    if (error) break;
    path = path.parent_path() / next;
  }
  return path;
}

/// A file that is open for writing; `shown` is what messages call it.
class OpenFile {
public:
  OpenFile(fs::path shown, int number)
      : shown_(std::move(shown)),
        file_(number) {
    if (number < 0) fail(shown_, reason(errno));
  }

  int number() const { return file_.get(); }

  void write(std::string_view bytes) const {
    if (const auto error = write_all(file_, bytes)) fail(shown_, error.message());
  }

  /// Waits until the disk has what was written, so that a name is never given to a file that a power cut leaves empty.
  /// Where a file system cannot say, so be it.
  void reach_the_disk() const {
    if (::fsync(number()) != 0 && errno != EINVAL && errno != ENOSYS) fail(shown_, reason(errno));
  }

private:
  fs::path shown_;
  FileDescriptor file_;
};

/// A file beside a target that nobody else can have guessed or laid there; it is gone at the end unless it was renamed.
/// It is locked as long as somebody writes it: what is not locked is left over.
class Temporary {
public:
  Temporary(const fs::path& target, const fs::path& shown, mode_t mode)
      : path_(folder_of(target)),
        file_(shown, make(mode)) {
    ::flock(file_.number(), LOCK_EX | LOCK_NB);
  }
  ~Temporary() {
    std::error_code ignored;
    if (!renamed_) fs::remove(path_, ignored);
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  const OpenFile& file() const { return file_; }

  void rename_to(const fs::path& target, const fs::path& shown) {
    std::error_code error;
    fs::rename(path_, target, error);
    if (error) fail(shown, error.message());
    renamed_ = true;
  }

private:
  int make(mode_t mode) {
    const fs::path folder = path_;
    for (int attempt = 0;; ++attempt) {
      std::uint64_t number = 0;
      if (::getrandom(&number, sizeof number, 0) != sizeof number) return -1;
      path_ = folder / fmt::format("{}{:016x}{}", temporary_begin, number, temporary_end);
      const int file = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode);
      if (file >= 0 || errno != EEXIST || attempt == 100) return file;
    }
  }

  fs::path path_;
  OpenFile file_;
  bool renamed_ = false;
};

bool is_temporary(const std::string& name) {
  constexpr std::size_t digits = 16;
  return name.size() == temporary_begin.size() + digits + temporary_end.size() && name.starts_with(temporary_begin) &&
         name.ends_with(temporary_end) &&
         name.find_first_not_of("0123456789abcdef", temporary_begin.size()) == temporary_begin.size() + digits;
}

/// True for a temporary file that nobody writes.
bool is_left_over(const fs::path& path) {
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  return file.get() >= 0 && ::flock(file.get(), LOCK_EX | LOCK_NB) == 0;
}

bool is_special(const struct stat& status) { return !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode); }

}  // namespace

fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

std::string read_file(const fs::path& path, std::size_t largest) {
  const std::string too_large =
      fmt::format("larger than {} MiB, which no file of this kind is; check the name", largest >> 20U);
  std::error_code error;
  const auto status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) refuse_file(path.string(), "no such file; check the name");
  if (!fs::exists(status)) refuse_file(path.string(), "cannot be opened: " + error.message());
  if (fs::is_directory(status)) refuse_file(path.string(), "is a directory, not a file; name a file in it");
  if (fs::is_regular_file(status) && fs::file_size(path, error) > largest) refuse_file(path.string(), too_large);
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse_file(path.string(), std::string("cannot be opened: ") + std::strerror(errno));
  // Pipes have no size: read up to the limit and refuse what is longer.
  std::string text;
  char block[65536];
  while (file.read(block, sizeof block), file.gcount() > 0) {
    text.append(block, static_cast<std::size_t>(file.gcount()));
    if (text.size() > largest) refuse_file(path.string(), too_large);
  }
  if (file.bad()) refuse_file(path.string(), "cannot be read");
  return text;
}

std::string read_ordinary_file(const fs::path& path, std::size_t largest) {
  std::error_code error;
  const auto status = fs::status(path, error);
  if (fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status))
    refuse_file(path.string(), "is no ordinary file; check the name");
  return read_file(path, largest);
}

std::string read_text_file(const fs::path& path) { return read_file(path, largest_text_file); }

void require_writable(const fs::path& path) {
  if (path.empty()) fail(path, "no name is given");
  struct stat status {};
  const bool exists = ::stat(path.c_str(), &status) == 0;
  if (!exists && errno != ENOENT) fail(path, reason(errno));
  if (exists && S_ISDIR(status.st_mode)) fail(path, "it is a directory; name a file in it");
  if (!path.has_filename()) fail(path, "it names no file");
  if (exists && is_special(status)) return;
  const fs::path target = behind_links(path);
  const fs::path folder = folder_of(target);
  std::error_code error;
  if (!fs::is_directory(folder, error)) fail(path, "there is no such folder; make it or name another");
  if (::access(folder.c_str(), W_OK | X_OK) != 0) fail(path, reason(errno) + "; name another place");
}

void write_file(const fs::path& path, const std::function<void(std::ostream&)>& content) {
  std::ostringstream text;
  content(text);
  if (!text) fail(path, "its content could not be made");
  write_file(path, std::move(text).str());
}

void write_file(const fs::path& path, std::string_view content) {
  struct stat status {};
  const bool exists = ::stat(path.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) fail(path, "it is a directory; name a file in it");
  // A device or a pipe (/dev/null, /dev/stdout) is written to; a rename would put a file in its place.
  if (exists && is_special(status)) return OpenFile(path, ::open(path.c_str(), O_WRONLY | O_CLOEXEC)).write(content);

  const fs::path target = behind_links(path);
  const mode_t permissions = status.st_mode & 07777;
  Temporary temporary(target, path, exists ? permissions & 0700 : 0666);
  temporary.file().write(content);
  if (exists) ::fchmod(temporary.file().number(), permissions);
  temporary.file().reach_the_disk();
  temporary.rename_to(target, path);
}

void remove_cut_off_writes(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> left;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (is_temporary(entry->path().filename().string()) && is_left_over(entry->path())) left.push_back(entry->path());
  for (const auto& file : left) fs::remove(file, error);
}

}  // namespace folk
