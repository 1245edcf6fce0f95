#include <folk/analysis/play/workers.h>

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <functional>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace folk {
namespace {

TEST(WorkersThreads, DoEachPieceOnceInEveryOneOfManyRuns) {
  for (const unsigned threads : {1U, 2U, 5U}) {
    Workers workers(threads);
    EXPECT_EQ(workers.threads(), threads);
    std::vector<int> done(37, 0);  // written without a lock: a piece belongs to one thread, and runs do not overlap
    for (int run = 0; run < 2000; ++run) workers.run(done.size(), [&](std::size_t i, unsigned) { ++done[i]; });
    EXPECT_EQ(done, std::vector<int>(37, 2000));
  }
}

// What one run wrote the next one sees, on any thread.
TEST(WorkersThreads, SeeWhatTheRunBeforeLeft) {
  Workers workers(5);
  std::vector<long> numbers(64, 1);
  for (int run = 0; run < 500; ++run) {
    const std::vector<long> before = numbers;
    workers.run(numbers.size(),
                [&](std::size_t i, unsigned) { numbers[i] = (before[i] + before[63 - i]) % 1'000'003; });
  }
  long wanted = 1;
  for (int run = 0; run < 500; ++run) wanted = 2 * wanted % 1'000'003;
  EXPECT_EQ(numbers, std::vector<long>(64, wanted));
}

TEST(WorkersThreads, AreTheSameAllAlongAndEachHasANumber) {
  for (const unsigned threads : {1U, 2U, 5U}) {
    Workers workers(threads);
    std::vector<std::set<std::thread::id>> seen(threads);
    for (int run = 0; run < 200; ++run)
      workers.run(20, [&](std::size_t, unsigned worker) { seen.at(worker).insert(std::this_thread::get_id()); });
    for (const auto& ids : seen) EXPECT_LE(ids.size(), 1U);
    // The caller is the first of them.
    EXPECT_TRUE(seen[0].empty() || *seen[0].begin() == std::this_thread::get_id());
    if (threads == 1) {
      EXPECT_EQ(seen[0].size(), 1U);
    }
  }
}

/// All of them are at work at once: each waits in its piece until the others are there too.
TEST(WorkersThreads, WorkAtTheSameTime) {
  Workers workers(3);
  if (workers.threads() < 3) GTEST_SKIP() << "no threads left";
  for (int run = 0; run < 20; ++run) {
    std::atomic<int> there{0};
    workers.run(3, [&](std::size_t, unsigned) {
      ++there;
      while (there < 3) std::this_thread::yield();
    });
    EXPECT_EQ(there, 3);
  }
}

/// What run() throws when these pieces throw their numbers.
std::string thrown(Workers& workers, std::size_t count, const std::set<std::size_t>& bad, std::atomic<int>& begun) {
  try {
    workers.run(count, [&](std::size_t i, unsigned) {
      ++begun;
      if (bad.contains(i)) throw std::runtime_error(std::to_string(i));
    });
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "nothing";
}

TEST(WorkersThreads, RethrowWhatTheEarliestPieceThrew) {
  for (const unsigned threads : {1U, 2U, 5U}) {
    Workers workers(threads);
    for (int run = 0; run < 200; ++run) {
      std::atomic<int> begun{0};
      EXPECT_EQ(thrown(workers, 1000, {3, 4, 5, 700}, begun), "3");
      EXPECT_GE(begun, 4);
      begun = 0;
      EXPECT_EQ(thrown(workers, 50, {}, begun), "nothing");  // and are as good as new
      EXPECT_EQ(begun, 50);
    }
  }
}

// The later piece throws while the earlier one is still at work.
TEST(WorkersThreads, WaitForEarlierPiecesThatMayThrowAsWell) {
  Workers workers(2);
  if (workers.threads() < 2) GTEST_SKIP() << "no threads left";
  for (int run = 0; run < 50; ++run) {
    std::atomic<bool> later_threw{false};
    try {
      workers.run(2, [&](std::size_t i, unsigned) {
        if (i == 1) {
          later_threw = true;
          throw std::runtime_error("one");
        }
        while (!later_threw) std::this_thread::yield();
        throw std::runtime_error("zero");
      });
      FAIL();
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(std::string(error.what()), "zero");
    }
  }
}

TEST(WorkersThreads, BeginNoFurtherPiecesAfterAFailure) {
  Workers workers(3);
  std::atomic<int> begun{0};
  EXPECT_EQ(thrown(workers, 1'000'000, {7}, begun), "7");
  EXPECT_LT(begun, 1'000'000);
}

TEST(WorkersThreads, DoNothingForNothing) {
  for (const unsigned threads : {0U, 1U, 5U}) {
    Workers workers(threads);
    EXPECT_GE(workers.threads(), 1U);
    workers.run(0, [](std::size_t, unsigned) { FAIL(); });
    std::atomic<int> done{0};
    workers.run(1, [&](std::size_t, unsigned) { ++done; });
    EXPECT_EQ(done, 1);
  }
}

TEST(WorkersThreads, MayComeAndGoWithoutWork) {
  for (int i = 0; i < 50; ++i) Workers workers(5);
}

}  // namespace
}  // namespace folk
