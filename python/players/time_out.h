#pragma once
// An end for calls of Python code that do not end by themselves.

#include <pybind11/pybind11.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

namespace folk::python {

/// Watches the calls of one player, with a thread of its own that goes with it.
class TimeOut {
public:
  /// Of so many seconds a call; nothing is watched where there is no number.
  explicit TimeOut(std::optional<double> seconds);
  ~TimeOut();
  TimeOut(const TimeOut&) = delete;
  TimeOut& operator=(const TimeOut&) = delete;

  /// Around a call, with the GIL. `end` says whether the call was interrupted, and takes back what of that is still to
  /// come.
  void begin();
  bool end();

private:
  using Clock = std::chrono::steady_clock;

  void watch();
  void interrupt();

  std::optional<Clock::duration> most_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Clock::time_point> due_;  // when the call that is on is interrupted, or interrupted again
  unsigned long caller_ = 0;              // Python's number of its thread
  pthread_t thread_{};
  bool in_main_thread_ = false;
  bool interrupted_ = false;
  bool over_ = false;
  std::thread watcher_;
};

}  // namespace folk::python
