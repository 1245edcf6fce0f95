#include <folk/games/error.h>
#include <folk/games/text_file.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <fstream>
#include <optional>
#include <system_error>
#include <vector>

namespace folk {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& path, const std::string& why) {
  throw EnvironmentError(fmt::format("{}: cannot be written: {}", excerpt(path.string(), 1000), why));
}

/// Where a write to `path` ends up: a symbolic link stays one, the file it names is replaced.
fs::path behind_links(const fs::path& path) {
  std::error_code error;
  const fs::path real = fs::canonical(path, error);
  return error ? path : real;
}

/// Writes in place.
void write_through(const fs::path& path, const fs::path& shown, const std::function<void(std::ostream&)>& content) {
  errno = 0;
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  if (!file) fail(shown, std::strerror(errno));
  content(file);
  errno = 0;
  file.close();
  if (!file) fail(shown, errno != 0 ? std::strerror(errno) : "the disk is full or failing");
}

/// Waits until the disk has what was written, so that a name is never given to a file that a power cut leaves empty.
/// Where a file system cannot say, so be it.
void reach_the_disk(const fs::path& path, const fs::path& shown) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return;
  const bool failed = ::fsync(file) != 0 && errno != EINVAL && errno != ENOSYS;
  const int why = errno;
  ::close(file);
  if (failed) fail(shown, std::strerror(why));
}

/// The process of a temporary name "path.PID.SERIAL.tmp"; nothing for any other name.
std::optional<pid_t> writer_of(const std::string& name, const std::string& path) {
  constexpr std::string_view end = ".tmp";
  if (!name.starts_with(path + ".") || !name.ends_with(end) || name.size() < path.size() + 1 + end.size())
    return std::nullopt;
  const char* at = name.data() + path.size() + 1;
  const char* stop = name.data() + name.size() - end.size();
  pid_t process = 0;
  unsigned serial = 0;
  const auto first = std::from_chars(at, stop, process);
  if (first.ec != std::errc() || first.ptr == stop || *first.ptr != '.' || process <= 0) return std::nullopt;
  const auto second = std::from_chars(first.ptr + 1, stop, serial);
  if (second.ec != std::errc() || second.ptr != stop) return std::nullopt;
  return process;
}

}  // namespace

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

std::string read_text_file(const fs::path& path) { return read_file(path, largest_text_file); }

void write_file(const fs::path& path, const std::function<void(std::ostream&)>& content) {
  std::error_code error;
  const auto status = fs::status(path, error);
  if (fs::is_directory(status)) fail(path, "it is a directory; name a file in it");
  const fs::path target = behind_links(path);
  // A device or a pipe (/dev/null, /dev/stdout) is written to; a rename would put a file in its place.
  if (fs::exists(status) && !fs::is_regular_file(status)) return write_through(target, path, content);

  // The process and a counter in the name keep two writers of one path apart.
  static std::atomic<unsigned> serial{0};
  const fs::path temporary = target.string() + fmt::format(".{}.{}.tmp", ::getpid(), serial++);
  std::error_code ignored;
  try {
    write_through(temporary, path, content);
    reach_the_disk(temporary, path);
    if (fs::exists(status)) fs::permissions(temporary, status.permissions(), ignored);
    fs::rename(temporary, target, error);
    if (error) fail(path, error.message());
  } catch (...) {
    fs::remove(temporary, ignored);
    throw;
  }
}

void write_file(const fs::path& path, std::string_view content) {
  write_file(path, [&](std::ostream& out) { out.write(content.data(), static_cast<std::streamsize>(content.size())); });
}

void remove_cut_off_writes(const fs::path& path) {
  const fs::path target = behind_links(path);
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  std::error_code error;
  std::vector<fs::path> left;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const auto process = writer_of(entry->path().filename().string(), target.filename().string());
    if (process && ::kill(*process, 0) != 0 && errno == ESRCH) left.push_back(entry->path());
  }
  for (const auto& file : left) fs::remove(file, error);
}

}  // namespace folk
