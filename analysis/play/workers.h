#pragma once
// Threads that stay, for work that is asked for thousands of times a second.

#include <cstddef>
#include <functional>
#include <memory>

namespace folk {

/// As many threads as are asked for, the caller's own among them; fewer where the system starts no more.
class Workers {
public:
  explicit Workers(unsigned threads);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  unsigned threads() const;

  /// Calls work(i, worker) once for every i below `count`, as parallel_for of parallel.h does, and waits. When a piece
  /// throws, the exception of the earliest piece that threw is rethrown.
  void run(std::size_t count, const std::function<void(std::size_t, unsigned)>& work);

private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace folk
