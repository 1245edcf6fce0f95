#pragma once
// Programs that took long to start and wait for another match.

#include <folk/strategies/programs/child_process.h>

#include <chrono>
#include <cstddef>
#include <memory>
#include <mutex>
#include <string_view>
#include <vector>

namespace folk {

/// The idle programs of one command: what a player has finished with, the next one plays with. Any thread may give and
/// take. Those that are left are told "end" when the object goes.
class IdlePrograms {
public:
  /// A program that gave its first answer sooner is as well started anew for each player.
  static constexpr std::chrono::milliseconds long_start{1000};

  /// More are not kept.
  static constexpr std::size_t most = 16;

  /// `worth_keeping`: what counts as a long start.
  explicit IdlePrograms(std::chrono::milliseconds worth_keeping = long_start)
      : worth_keeping_(worth_keeping) {}
  ~IdlePrograms();
  IdlePrograms(const IdlePrograms&) = delete;
  IdlePrograms& operator=(const IdlePrograms&) = delete;

  std::chrono::milliseconds worth_keeping() const { return worth_keeping_; }

  /// Keeps a program that waits for a match, or lets it end.
  void give(std::unique_ptr<ChildProcess> program);

  /// One that waits, those that have ended meanwhile left out; null where there is none.
  std::unique_ptr<ChildProcess> take();

private:
  std::chrono::milliseconds worth_keeping_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<ChildProcess>> idle_;
};

}  // namespace folk
