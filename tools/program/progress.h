#pragma once
// A progress bar on stderr for work that takes a while.

#include <chrono>
#include <cstddef>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

namespace folk::tools {

/// The bar as one line: "playing [######--------------]  31 %, 0:12 left", at most `width` characters.
/// `fraction` is clamped to [0, 1]; without `seconds_left` the last part is left out.
std::string progress_line(const std::string& what, double fraction, std::optional<double> seconds_left,
                          std::size_t width);

/// Writes to stderr at once.
void show(const std::string& text);

/// Columns of the terminal that stderr is; 80 where it does not say.
std::size_t terminal_width();

/// "0:07", "12:30", "3:05:00"; nothing beyond a hundred hours, where an estimate says little.
std::string duration(double seconds);

/// Shows how far some work has got once it has lasted a second, a few times a second, and removes itself at the end.
/// Any thread may report; the highest fraction counts.
class ProgressBar {
public:
  /// On stderr, where that is a terminal and `enabled` is set.
  ProgressBar(std::string what, bool enabled);
  /// On a page that knows no more of terminals than that "\r" begins the line again; `write` adds to it.
  ProgressBar(std::string what, std::function<void(const std::string&)> write);
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  ~ProgressBar();

  /// The share of the work that is done, 0 to 1.
  void operator()(double fraction);

  /// Makes way for a line that somebody is about to write; the next report draws the bar again.
  void make_way();

private:
  using Clock = std::chrono::steady_clock;

  void draw(const std::string& line);
  void remove();

  std::string what_;
  bool shows_;
  bool on_page_;
  std::function<void(const std::string&)> write_;
  Clock::time_point begin_ = Clock::now();
  Clock::time_point next_ = begin_ + std::chrono::seconds(1);
  double fraction_ = 0;
  std::size_t drawn_ = 0;  ///< characters that stand there
  std::mutex mutex_;
};

}  // namespace folk::tools
