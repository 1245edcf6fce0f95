#pragma once
// The threads of one rank, which do pieces while the rank's own thread talks to the others.

#include <folk/analysis/crew/crew.h>

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace folk {

class Hands {
public:
  /// `work` must outlive this. With `packed` finished pieces come with their bytes.
  Hands(const SharedWork& work, bool packed);
  /// Pieces that were not begun are not done; those that were are waited for.
  ~Hands();
  Hands(const Hands&) = delete;
  Hands& operator=(const Hands&) = delete;

  /// A piece to do, after those given before.
  void give(std::size_t piece);

  struct Finished {
    std::size_t piece = 0;
    std::string bytes{};
    std::exception_ptr failure{};  ///< what it threw, if it did
  };

  /// A piece that is done or has thrown.
  std::optional<Finished> take();

  /// Waits until there is one, but not longer than this. Where no thread could be started it does a piece itself.
  void wait(std::chrono::microseconds longest);

private:
  void stand_by(unsigned worker);
  void finish(std::unique_lock<std::mutex>& lock, unsigned worker);

  const SharedWork& work_;
  bool packed_;
  std::mutex mutex_;
  std::condition_variable given_;
  std::condition_variable done_;
  std::deque<std::size_t> waiting_;
  std::deque<Finished> finished_;
  bool ending_ = false;
  const std::function<void(unsigned)> body_ = [this](unsigned worker) { stand_by(worker); };
  std::vector<std::jthread> threads_;
};

}  // namespace folk
