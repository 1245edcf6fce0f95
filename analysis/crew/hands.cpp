#include <folk/analysis/crew/hands.h>
#include <folk/analysis/play/parallel.h>

#include <algorithm>
#include <utility>

namespace folk {

Hands::Hands(const SharedWork& work, bool packed)
    : work_(work),
      packed_(packed),
      threads_(start_threads(std::max(1U, work.threads), body_)) {}

Hands::~Hands() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
    waiting_.clear();
  }
  given_.notify_all();
  threads_.clear();  // joins them, while all that they use is there
}

void Hands::give(std::size_t piece) {
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(piece);
  }
  given_.notify_one();
}

std::optional<Hands::Finished> Hands::take() {
  const std::lock_guard lock(mutex_);
  if (finished_.empty()) return std::nullopt;
  Finished first = std::move(finished_.front());
  finished_.pop_front();
  return first;
}

void Hands::wait(std::chrono::microseconds longest) {
  std::unique_lock lock(mutex_);
  if (threads_.empty() && !waiting_.empty()) return finish(lock, 0);
  done_.wait_for(lock, longest, [this] { return !finished_.empty(); });
}

void Hands::stand_by(unsigned worker) {
  std::unique_lock lock(mutex_);
  for (;;) {
    given_.wait(lock, [this] { return ending_ || !waiting_.empty(); });
    if (ending_) return;
    finish(lock, worker);
    done_.notify_one();
  }
}

void Hands::finish(std::unique_lock<std::mutex>& lock, unsigned worker) {
  Finished finished{waiting_.front()};
  waiting_.pop_front();
  lock.unlock();
  try {
    work_.work(finished.piece, worker);
    if (packed_) finished.bytes = work_.pack(finished.piece);
  } catch (...) {
    finished.failure = std::current_exception();
  }
  lock.lock();
  finished_.push_back(std::move(finished));
}

}  // namespace folk
