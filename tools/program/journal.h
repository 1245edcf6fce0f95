#pragma once
// The file of --journal: written now and then, so that a kill loses little, and read when the same command comes again.

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace folk::tools {

class Journal {
public:
  /// Nothing is kept without a path, nor on ranks that do not write (launch.h). Throws EnvironmentError where the file
  /// cannot be written.
  explicit Journal(std::optional<std::filesystem::path> path);

  /// What an earlier run left. Throws InputFileError where it cannot be read.
  std::optional<std::string> read() const;

  /// Writes what `text` says when it is time again: soon after the start, then every two seconds, or less often where
  /// more than a tenth of the time would go into it.
  void now_and_then(const std::function<std::string()>& text);

  /// Writes at once.
  void write(const std::string& text);

  std::string name() const { return path_ ? path_->string() : std::string(); }
  explicit operator bool() const { return path_.has_value(); }

private:
  using Clock = std::chrono::steady_clock;

  std::optional<std::filesystem::path> path_;
  Clock::time_point next_;
};

}  // namespace folk::tools
