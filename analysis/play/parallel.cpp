#include <folk/analysis/play/parallel.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <vector>

namespace folk {

std::vector<std::jthread> start_threads(unsigned count, const std::function<void(unsigned)>& body) {
  std::vector<std::jthread> threads;
  threads.reserve(count);
  try {
    while (threads.size() < count)
      threads.emplace_back([&body, number = static_cast<unsigned>(threads.size())] { body(number); });
  } catch (const std::system_error&) {
  } catch (const std::bad_alloc&) {
  }
  return threads;
}

void parallel_for(std::size_t count, unsigned threads, const std::function<void(std::size_t, unsigned)>& work,
                  const Progress& progress) {
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::size_t done = 0;
  bool silent = false;                        // once something was thrown: nobody is told any more
  std::atomic<std::size_t> failed_at{count};  // pieces before it are still done: one of them may throw as well
  std::exception_ptr failure;
  const auto run = [&](unsigned worker) {
    for (std::size_t i = next++; i < failed_at; i = next++) {
      try {
        progress.check();
        work(i, worker);
        if (progress) {
          const std::lock_guard lock(mutex);
          if (!silent) {
            silent = true;  // and stays so when the next line throws
            progress(static_cast<double>(++done) / static_cast<double>(count));
            silent = false;
          }
        }
      } catch (...) {
        const std::lock_guard lock(mutex);
        silent = true;
        if (i < failed_at) {
          failed_at = i;
          failure = std::current_exception();
        }
      }
    }
  };
  const auto workers =
      static_cast<unsigned>(std::min<std::size_t>(std::max(1U, threads), std::max<std::size_t>(1, count)));
  {
    const std::function<void(unsigned)> beside = [&run](unsigned number) { run(number + 1); };
    const auto others = start_threads(workers - 1, beside);
    run(0);
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace folk
