#pragma once
// Independent pieces of work on several threads.

#include <cstddef>
#include <functional>

namespace folk {

/// Calls work(i, worker) once for every i below `count`; `worker` (below `threads`) tells whose scratch space to use.
/// One thread runs in the caller's own. When a piece throws, no further ones begin, and the exception of the earliest
/// piece that threw is rethrown. `progress` is told the finished share, from 0 to 1, by one thread at a time.
void parallel_for(std::size_t count, unsigned threads, const std::function<void(std::size_t, unsigned)>& work,
                  const std::function<void(double)>& progress = nullptr);

}  // namespace folk
