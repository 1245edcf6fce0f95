#include "games/expect_error.h"

#include <folk/analysis/play/sampled_play.h>
#include <folk/strategies/registry.h>
#include <gtest/gtest.h>

namespace folk {
namespace {

TEST(Repetitions, AreAWholeNumberAboveZero) {
  EXPECT_EQ(Repetitions(1).count(), 1U);
  EXPECT_EQ(Repetitions(300), 300U);
  test::expect_error<UsageError>([] { Repetitions(0); }, "repetitions: expected at least 1");
}

// A match that was never to be played went on for ever.
TEST(Repetitions, ASampleOfNoMatchesCannotBeAskedFor) {
  Sampling sampling;
  EXPECT_THROW(sampling.repetitions = 0, UsageError);
  sampling.criterion = Criterion::finite(10);
  sampling.repetitions = 1;
  const auto random = Registry::standard().make("random(0.5)");
  const auto pairs = play_sampled({Contest{&random, &random}}, sampling);
  double rounds = 0;
  for (const double weight : pairs.front().weights) rounds += weight;
  EXPECT_EQ(rounds, 10) << "one match of 10 rounds";
}

}  // namespace
}  // namespace folk
