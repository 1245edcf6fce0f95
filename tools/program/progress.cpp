#include <folk/tools/program/launch.h>
#include <folk/tools/program/progress.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <sys/ioctl.h>
#include <unistd.h>

namespace folk::tools {

void show(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

std::size_t terminal_width() {
  winsize size{};
  return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

std::string duration(double seconds) {
  if (!(seconds >= 0 && seconds < 360000)) return {};
  const auto whole = static_cast<unsigned>(std::lround(seconds));
  const unsigned hours = whole / 3600;
  return hours > 0 ? fmt::format("{}:{:02}:{:02}", hours, whole / 60 % 60, whole % 60)
                   : fmt::format("{}:{:02}", whole / 60, whole % 60);
}

std::string progress_line(const std::string& what, double fraction, std::optional<double> seconds_left,
                          std::size_t width) {
  constexpr std::size_t bar = 20;
  const double share = std::isfinite(fraction) ? std::clamp(fraction, 0.0, 1.0) : 0.0;
  const auto full = static_cast<std::size_t>(share * bar);
  std::string line = fmt::format("{} [{}{}] {:3.0f} %", what, std::string(full, '#'), std::string(bar - full, '-'),
                                 std::floor(100 * share));
  if (seconds_left)
    if (const std::string left = duration(*seconds_left); !left.empty()) line += ", " + left + " left";
  if (line.size() > width) line.resize(width);
  return line;
}

ProgressBar::ProgressBar(std::string what, bool enabled)
    : what_(std::move(what)),
      shows_(enabled && speaks() && ::isatty(STDERR_FILENO) == 1),
      on_page_(false),
      write_(show) {}

ProgressBar::ProgressBar(std::string what, std::function<void(const std::string&)> write)
    : what_(std::move(what)),
      shows_(true),
      on_page_(true),
      write_(std::move(write)) {}

ProgressBar::~ProgressBar() {
  try {
    remove();
  } catch (...) {  // a page that cannot be written to has nothing that could be in the way
  }
}

void ProgressBar::draw(const std::string& line) {
  const std::size_t longer = drawn_ > line.size() ? drawn_ - line.size() : 0;
  write_("\r" + line + (on_page_ ? std::string(longer, ' ') : "\x1b[K"));
  drawn_ = line.size();
}

void ProgressBar::remove() {
  if (drawn_ == 0) return;
  draw("");
  if (on_page_) write_("\r");
}

void ProgressBar::operator()(double fraction) {
  if (!shows_) return;
  const std::lock_guard lock(mutex_);
  fraction_ = std::max(fraction_, fraction);
  const auto now = Clock::now();
  if (now < next_) return;
  next_ = now + std::chrono::milliseconds(200);
  const double elapsed = std::chrono::duration<double>(now - begin_).count();
  std::optional<double> left;
  if (fraction_ > 0) left = elapsed * (1 - fraction_) / fraction_;
  // The last column stays free: a terminal may wrap after it.
  draw(progress_line(what_, fraction_, left, on_page_ ? 80 : terminal_width() - 1));
}

void ProgressBar::make_way() {
  const std::scoped_lock lock(mutex_);
  remove();
}

}  // namespace folk::tools
