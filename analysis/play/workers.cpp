#include <folk/analysis/play/parallel.h>
#include <folk/analysis/play/workers.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace folk {

namespace {

/// Work often follows at once: it is looked for so many times before a thread lies down to sleep.
constexpr int looks = 2000;

template <class Condition>
void look_for(const Condition& condition) {
  for (int i = 0; i < looks && !condition(); ++i) {
#if defined(__x86_64__)
    __builtin_ia32_pause();
#endif
  }
}

}  // namespace

struct Workers::State {
  std::mutex mutex;
  std::condition_variable wake;
  std::condition_variable rest;
  std::atomic<std::uint64_t> task{0};  // counts them
  std::atomic<std::size_t> busy{0};    // threads beside the caller's that are not done with it
  bool ending = false;
  const std::function<void(std::size_t, unsigned)>* work = nullptr;
  std::size_t count = 0;
  std::atomic<std::size_t> next{0};
  std::size_t failed_at = 0;
  std::exception_ptr failure;
  const std::function<void(unsigned)> body = [this](unsigned number) { stand_by(number + 1); };
  std::vector<std::jthread> threads;

  void take_pieces(unsigned worker) {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        (*work)(i, worker);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!failure || i < failed_at) {
          failed_at = i;
          failure = std::current_exception();
        }
        next = count;  // no further pieces begin
      }
    }
  }

  void stand_by(unsigned worker) {
    std::uint64_t done = 0;
    for (;;) {
      look_for([&] { return task != done; });
      std::unique_lock lock(mutex);
      wake.wait(lock, [&] { return ending || task != done; });
      if (ending) return;
      done = task;
      lock.unlock();
      take_pieces(worker);
      lock.lock();
      if (--busy == 0) rest.notify_one();
      lock.unlock();
    }
  }
};

Workers::Workers(unsigned threads)
    : state_(std::make_unique<State>()) {
  state_->threads = start_threads(std::max(1U, threads) - 1, state_->body);
}

Workers::~Workers() {
  {
    const std::lock_guard lock(state_->mutex);
    state_->ending = true;
  }
  state_->wake.notify_all();
}

unsigned Workers::threads() const { return static_cast<unsigned>(state_->threads.size()) + 1; }

void Workers::run(std::size_t count, const std::function<void(std::size_t, unsigned)>& work) {
  State& state = *state_;
  {
    const std::lock_guard lock(state.mutex);
    state.work = &work;
    state.count = count;
    state.next = 0;
    state.failure = nullptr;
    state.busy = state.threads.size();
    ++state.task;
  }
  state.wake.notify_all();
  state.take_pieces(0);
  look_for([&] { return state.busy == 0; });
  std::unique_lock lock(state.mutex);
  state.rest.wait(lock, [&] { return state.busy == 0; });
  if (state.failure) std::rethrow_exception(state.failure);
}

}  // namespace folk
