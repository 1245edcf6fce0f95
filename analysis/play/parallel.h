#pragma once
// Independent pieces of work on several threads.

#include <folk/games/progress.h>

#include <cstddef>
#include <functional>
#include <thread>
#include <vector>

namespace folk {

/// Threads that call body(0), body(1), ... once each and end; `body` must outlive them. Fewer than `count` where the
/// system starts no more: ask the size.
std::vector<std::jthread> start_threads(unsigned count, const std::function<void(unsigned)>& body);

/// Calls work(i, worker) once for every i below `count`; `worker` (below `threads`) tells whose scratch space to use.
/// The caller is one of the threads; where the system starts fewer, the work and its results are the same. When a piece
/// throws, no further ones begin, and the exception of the earliest piece that threw is rethrown; what `progress`
/// throws after a piece counts as thrown by that piece. It is told the finished share, from 0 to 1, until something was
/// thrown, and asked before a piece begins.
void parallel_for(std::size_t count, unsigned threads, const std::function<void(std::size_t, unsigned)>& work,
                  const Progress& progress = nullptr);

}  // namespace folk
