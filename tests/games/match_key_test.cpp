#include <folk/games/match_key.h>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace folk {
namespace {

TEST(MatchKey, RolesKeepTheNumbersThatSeededResultsWereDrawnWith) {
  EXPECT_EQ(match_key(1, 2, 3, MatchRole::first).role, 0U);
  EXPECT_EQ(match_key(1, 2, 3, MatchRole::second).role, 1U);
  EXPECT_EQ(match_key(1, 2, 3, MatchRole::noise).role, 2U);
  EXPECT_EQ(match_key(1, 2, 3, MatchRole::length).role, 3U);
}

TEST(MatchKey, EverySeatDrawsInItsOwnRole) {
  EXPECT_EQ(role_of(Seat::first), MatchRole::first);
  EXPECT_EQ(role_of(Seat::second), MatchRole::second);
}

RC_GTEST_PROP(MatchKeyProperty, SaysSeedPairAndRepetitionInThisOrder,
              (std::uint64_t seed, std::uint64_t pair, std::uint64_t repetition)) {
  const RandomKey key = match_key(seed, pair, repetition, MatchRole::noise);
  RC_ASSERT(key.seed == seed);
  RC_ASSERT(key.pair == pair);
  RC_ASSERT(key.repetition == repetition);
}

}  // namespace
}  // namespace folk
