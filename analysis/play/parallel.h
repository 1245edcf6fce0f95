#pragma once
// Independent pieces of work on several threads.

#include <folk/games/progress.h>

#include <cstddef>
#include <functional>

namespace folk {

/// Calls work(i, worker) once for every i below `count`; `worker` (below `threads`) tells whose scratch space to use.
/// One thread runs in the caller's own. When a piece throws, no further ones begin, and the exception of the earliest
/// piece that threw is rethrown; what `progress` throws after a piece counts as thrown by that piece. It is told the
/// finished share, from 0 to 1, until something was thrown, and asked before a piece begins.
void parallel_for(std::size_t count, unsigned threads, const std::function<void(std::size_t, unsigned)>& work,
                  const Progress& progress = nullptr);

}  // namespace folk
