#include "made_play.h"
#include "strategies/named.h"

#include <folk/analysis/judgement/agreement.h>
#include <folk/games/error.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

namespace folk {
namespace {

Agreement agreement(const char* name, const std::vector<RecordedMatch>& matches, Seat seat = Seat::first) {
  return agreement_with(test::named(name), matches, seat, {});
}

TEST(Agreement, OfADeterministicMachineIsEveryMove) {
  const std::vector matches{test::match_of("CCDC", "CDCC"), test::match_of("CD", "DD")};
  EXPECT_TRUE(agreement("tit_for_tat", matches).consistent());
  EXPECT_TRUE(agreement("tit_for_tat", matches).certain());
  const auto spiteful = agreement("spiteful", matches);
  EXPECT_FALSE(spiteful.consistent());
  EXPECT_EQ(spiteful.impossible(), 1U);
  EXPECT_EQ(spiteful.first_impossible()->match, 0U);
  EXPECT_EQ(spiteful.first_impossible()->round, 3U);
  EXPECT_EQ(spiteful.rounds(), 6U);
}

TEST(Agreement, OfTheOtherSideIsTheirMoves) {
  const std::vector matches{test::match_of("CCDC", "CCCD")};
  EXPECT_TRUE(agreement("tit_for_tat", matches, Seat::second).consistent());
  EXPECT_FALSE(agreement("tit_for_tat", matches).consistent());
}

TEST(Agreement, SlipsFlipMovesAndAreSeenByWhoSlipped) {
  // pavlov slips in round 2; having played D it then goes on from DC, which it calls a success.
  const std::vector matches{test::match_of("CDDD", "CCCC")};
  EXPECT_NEAR(agreement("pavlov", matches).log_likelihood(0.1), 3 * std::log(0.9) + std::log(0.1), 1e-12);
  EXPECT_EQ(agreement("pavlov", matches).log_likelihood(0), -INFINITY);
  EXPECT_NEAR(agreement("all_c", matches).log_likelihood(0.1), std::log(0.9) + 3 * std::log(0.1), 1e-12);
}

TEST(Agreement, OfAMachineThatMixesIsByItsProbabilities) {
  const std::vector matches{test::match_of("CCDC", "CDDD")};
  const auto generous = agreement("gtft(0.25)", matches);  // C, C, then twice after a D
  EXPECT_TRUE(generous.consistent());
  EXPECT_FALSE(generous.certain());
  EXPECT_NEAR(generous.log_likelihood(0), std::log(0.75) + std::log(0.25), 1e-12);
  const double c = 0.25 * 0.9 + 0.75 * 0.1;
  EXPECT_NEAR(generous.log_likelihood(0.1), 2 * std::log(0.9) + std::log(1 - c) + std::log(c), 1e-12);
}

TEST(Agreement, OfAnOpaquePlayerIsAskedForItsMoves) {
  Strategy opaque;
  opaque.name = "opaque";
  const auto machine = test::named("pavlov").machine;
  opaque.make_player = [machine] { return play(machine); };
  opaque.deterministic = true;
  const std::vector matches{test::match_of("CDDD", "CCCC"), test::match_of("CD", "DD")};
  const auto asked = agreement_with(opaque, matches, Seat::first, {});
  const auto known = agreement("pavlov", matches);
  for (const double slip : {0.0, 0.01, 0.2}) EXPECT_EQ(asked.log_likelihood(slip), known.log_likelihood(slip));
  opaque.deterministic = false;
  EXPECT_THROW(agreement_with(opaque, matches, Seat::first, {}), UsageError);
}

}  // namespace
}  // namespace folk
