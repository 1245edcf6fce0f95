#include <folk/analysis/play/parallel.h>
#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "games/ended_work.h"

namespace folk {
namespace {

TEST(ParallelThreads, DoEachPieceOnce) {
  for (const unsigned threads : {1U, 2U, 5U}) {
    std::vector<int> done(1000, 0);
    parallel_for(done.size(), threads, [&](std::size_t i, unsigned worker) {
      ASSERT_LT(worker, threads);
      ++done[i];
    });
    EXPECT_EQ(done, std::vector<int>(1000, 1));
  }
}

TEST(ParallelThreads, RethrowAndStop) {
  std::atomic<int> begun{0};
  try {
    parallel_for(100'000, 3, [&](std::size_t i, unsigned) {
      ++begun;
      if (i == 7) throw std::runtime_error("seven");
    });
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(std::string(error.what()), "seven");
  }
  EXPECT_LT(begun, 100'000);
}

/// What is thrown when both of two pieces throw, the one that is named after the other.
std::string thrown_when_last_is(std::size_t last) {
  std::atomic<int> begun{0};
  std::atomic<bool> other_threw{false};
  try {
    parallel_for(2, 2, [&](std::size_t i, unsigned) {
      ++begun;
      while (begun < 2) std::this_thread::yield();
      if (i == last) {
        while (!other_threw) std::this_thread::yield();
      } else {
        other_threw = true;
      }
      throw std::runtime_error(std::to_string(i));
    });
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "nothing";
}

TEST(ParallelThreads, RethrowWhatTheEarliestPieceThrew) {
  for (int run = 0; run < 50; ++run) {
    EXPECT_EQ(thrown_when_last_is(0), "0");
    EXPECT_EQ(thrown_when_last_is(1), "0");
  }
}

TEST(ParallelThreads, EndAsTheirProgressWishes) {
  for (const unsigned threads : {1U, 4U})
    test::expect_ends([&](const Progress& progress) {
      std::vector<int> done(40, 0);
      const auto work = [&](std::size_t i, unsigned) { ++done[i]; };
      parallel_for(done.size(), threads, work, progress);
    });
}

// The second piece ends as soon as who was told of the first is about to throw.
TEST(ParallelThreads, TellNobodyAnyMoreOnceItHasThrown) {
  for (int run = 0; run < 50; ++run) {
    std::atomic<int> begun{0};
    std::atomic<int> told{0};
    const auto work = [&](std::size_t i, unsigned) {
      ++begun;
      while (begun < 2 || (i == 1 && told == 0)) std::this_thread::yield();
    };
    const auto tell = [&](double) {
      ++told;
      throw test::Enough();
    };
    EXPECT_THROW(parallel_for(2, 2, work, tell), test::Enough);
    EXPECT_EQ(told, 1);
  }
}

TEST(ParallelThreads, BeginNoPieceOnceCancelled) {
  for (const unsigned threads : {1U, 4U}) {
    const Progress progress;
    progress.cancel();
    const auto work = [](std::size_t, unsigned) { FAIL(); };
    EXPECT_THROW(parallel_for(100, threads, work, progress), Cancelled);
  }
}

TEST(ParallelThreads, ReportRisingProgress) {
  double last = 0;
  parallel_for(
      50, 4, [](std::size_t, unsigned) {},
      [&](double fraction) {
        EXPECT_GT(fraction, last);
        last = fraction;
      });
  EXPECT_EQ(last, 1.0);
}

TEST(Parallel, DoesNothingForNothing) {
  parallel_for(0, 4, [](std::size_t, unsigned) { FAIL(); });
}

}  // namespace
}  // namespace folk
