#include <folk/games/error.h>
#include <folk/games/progress.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <thread>
#include <vector>

namespace folk {
namespace {

TEST(Progress, TellsTheShares) {
  std::vector<double> told;
  const Progress progress = [&](double share) { told.push_back(share); };
  progress(0.25);
  progress(1);
  EXPECT_EQ(told, (std::vector<double>{0.25, 1}));
}

TEST(Progress, OfAStageIsAPartOfTheWhole) {
  std::vector<double> told;
  const Progress progress = [&](double share) { told.push_back(share); };
  const Progress stage = progress.part(0.25, 0.75);
  stage(0);
  stage(0.5);
  stage(1);
  stage.part(0.5, 1)(0.5);
  // The last stage's end is the end to the last bit, wherever it began.
  for (const double begin : {0.1, 0.3, 0.7}) progress.part(begin, 1).part(begin, 1)(1);
  EXPECT_EQ(told, (std::vector<double>{0.25, 0.5, 0.75, 0.625, 1, 1, 1}));
}

TEST(Progress, ThatNobodyAskedForDoesNothing) {
  const Progress nobody = nullptr;
  EXPECT_FALSE(nobody);
  nobody.cancel();
  EXPECT_FALSE(nobody.cancelled());
  nobody.check();
  nobody.part(0, 0.5)(1);
  EXPECT_TRUE(Progress());
}

TEST(Progress, CancelsItsCopiesAndParts) {
  int told = 0;
  const Progress progress = [&](double) { ++told; };
  const Progress copy = progress;
  const Progress stage = copy.part(0, 0.5);
  stage(0.5);
  stage.cancel();
  EXPECT_TRUE(progress.cancelled());
  EXPECT_TRUE(copy.cancelled());
  EXPECT_THROW(progress.check(), Cancelled);
  EXPECT_THROW(copy(0.5), Cancelled);
  EXPECT_THROW(stage(1), Cancelled);
  EXPECT_THROW(progress(1), Cancelled);
  EXPECT_EQ(told, 1);  // the cancelled ones told nobody
}

TEST(Progress, MayBeCancelledByWhoIsTold) {
  const Progress other;
  const Progress progress = [&](double) { other.cancel(); };
  progress(0.5);  // another's is none of its business
  Progress own;
  own = [&](double) { own.cancel(); };
  EXPECT_THROW(own(1), Cancelled);  // at the end too
  EXPECT_THROW(other.check(), Cancelled);
}

TEST(Progress, LetsThroughWhatWhoIsToldThrows) {
  const Progress progress = [](double) { throw std::runtime_error("enough"); };
  EXPECT_THROW(progress.part(0, 0.5)(0.5), std::runtime_error);
  EXPECT_FALSE(progress.cancelled());
}

TEST(Progress, AsksWhetherToGoOnUntilItIsDone) {
  bool stop = false;
  int told = 0;
  const Progress progress{[&](double) { ++told; }, [&] { return stop; }};
  progress(0.5);
  progress.check();
  stop = true;
  progress(1);  // what is done is done
  EXPECT_EQ(told, 2);
  EXPECT_THROW(progress.part(0, 0.5)(1), Cancelled);
  EXPECT_EQ(told, 2);
  stop = false;  // said once, said for good
  EXPECT_THROW(progress.check(), Cancelled);
  const Progress silent{nullptr, [] { return true; }};
  EXPECT_THROW(silent(0.5), Cancelled);
}

TEST(ProgressThread, MayCancelFromAnother) {
  const Progress progress;
  std::thread other([&] { progress.cancel(); });
  other.join();
  EXPECT_THROW(progress(0.5), Cancelled);
  const Progress told = [](double) {};
  std::thread later([told] { told.cancel(); });
  EXPECT_THROW(
      {
        for (;;) told(0.5);
      },
      Cancelled);
  later.join();
}

}  // namespace
}  // namespace folk
