#pragma once
// Does long work end as its progress wishes?

#include <folk/games/progress.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <functional>
#include <thread>

namespace folk::test {

/// What a progress throws that has had enough; nothing that anybody else could throw, or catch.
struct Enough {};

/// `work` must be told shares that rise to 1, the same number of them each time, and must end with what its progress
/// throws, and with Cancelled when it is cancelled by who is told, by another thread, or by the answer to its question:
/// at its first, a middle and its last report. Nobody may be told anything after that.
inline void expect_ends(const std::function<void(const Progress&)>& work) {
  std::size_t reports = 0;
  double last = 0;
  work([&](double share) {
    EXPECT_GE(share, last);
    last = share;
    ++reports;
  });
  EXPECT_NEAR(last, 1, 1e-12);
  ASSERT_GT(reports, 0U);
  for (const std::size_t end : {std::size_t{1}, (reports + 1) / 2, reports}) {
    std::size_t told = 0;
    const Progress throws = [&](double) {
      if (++told == end) throw Enough();
    };
    EXPECT_THROW(work(throws), Enough) << "at report " << end << " of " << reports;
    EXPECT_EQ(told, end);
    told = 0;
    Progress cancels;
    cancels = [&](double) {
      if (++told == end) cancels.cancel();
    };
    EXPECT_THROW(work(cancels), Cancelled) << "at report " << end << " of " << reports;
    EXPECT_EQ(told, end);
  }
  std::atomic<bool> begun = false;
  Progress waits;
  waits = [&](double) {
    begun = true;
    while (!waits.cancelled()) std::this_thread::yield();
  };
  std::thread other([&] {
    while (!begun) std::this_thread::yield();
    waits.cancel();
  });
  EXPECT_THROW(work(waits), Cancelled);
  other.join();
  EXPECT_THROW(work({nullptr, [] { return true; }}), Cancelled);
}

}  // namespace folk::test
