#include <folk/games/error.h>
#include <folk/games/text_file.h>
#include <folk/sct/files/checkpoint_files.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <optional>
#include <system_error>
#include <utility>

namespace folk::sct {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view prefix = "step-";
constexpr std::string_view suffix = ".checkpoint";

/// The step in a checkpoint's name.
std::optional<std::uint64_t> step_of(const fs::path& path) {
  const std::string name = path.filename().string();
  if (name.size() <= prefix.size() + suffix.size() || !name.starts_with(prefix) || !name.ends_with(suffix))
    return std::nullopt;
  const char* begin = name.data() + prefix.size();
  const char* end = name.data() + name.size() - suffix.size();
  std::uint64_t step = 0;
  const auto [stop, error] = std::from_chars(begin, end, step);
  if (error != std::errc() || stop != end) return std::nullopt;
  return step;
}

[[noreturn]] void fail(const fs::path& path, const std::string& why) {
  throw EnvironmentError(fmt::format("checkpoint folder {}: {}", excerpt(path.string(), 1000), why));
}

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    files.push_back(entry->path());
  if (error) fail(folder, "cannot be read: " + error.message());
  return files;
}

}  // namespace

CheckpointFiles::CheckpointFiles(fs::path path)
    : path_(std::move(path)) {
  std::error_code error;
  folder_.emplace(path_, error);
  if (std::error_code ignored; !fs::is_directory(path_, ignored))
    fail(path_, fmt::format("cannot be made: {}; name another", error ? error.message() : "a file has its name"));
  lock_ = FileDescriptor(::open((path_ / "lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
  if (lock_.get() < 0) fail(path_, fmt::format("cannot be written: {}; name another", std::strerror(errno)));
  if (::flock(lock_.get(), LOCK_EX | LOCK_NB) != 0)
    fail(path_, errno == EWOULDBLOCK ? "another run is using it; wait for its end or name another folder"
                                     : fmt::format("cannot be locked: {}; name another", std::strerror(errno)));
  remove_cut_off_writes(path_);
}

CheckpointFiles::~CheckpointFiles() {
  if (!folder_->made()) return;
  std::error_code error;
  int entries = 0;
  for (fs::directory_iterator entry(path_, error), end; !error && entry != end; entry.increment(error)) ++entries;
  if (!error && entries == 1) fs::remove(path_ / "lock", error);
}

std::vector<fs::path> CheckpointFiles::checkpoints() const {
  auto files = files_in(path_);
  std::erase_if(files, [](const fs::path& file) { return !step_of(file); });
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return *step_of(a) < *step_of(b); });
  return files;
}

bool CheckpointFiles::read_newest(const std::function<void(std::string_view, const std::string&)>& parse,
                                  const std::function<void(const std::string&)>& skipped) const {
  auto files = checkpoints();
  std::reverse(files.begin(), files.end());
  std::vector<InputFileError> faults;
  for (const auto& file : files) {
    try {
      parse(read_ordinary_file(file, largest_checkpoint), file.string());
      for (const auto& fault : faults) skipped(fault.what());
      return true;
    } catch (const InputFileError& error) {
      faults.push_back(error);
    }
  }
  if (!faults.empty()) throw InputFileError(faults.front());
  return false;
}

void CheckpointFiles::write_bytes(std::uint64_t step, std::string_view bytes) {
  write_file(path_ / fmt::format("{}{}{}", prefix, step, suffix), bytes);
  const auto files = checkpoints();
  std::error_code ignored;
  for (std::size_t i = 0; i + kept < files.size(); ++i) fs::remove(files[i], ignored);
}

}  // namespace folk::sct
