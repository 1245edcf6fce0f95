#include <folk/analysis/beliefs/belief_consistency.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace folk {
namespace {

BeliefRound round_of(double belief, Move theirs, double truth) { return {Move::C, theirs, belief, truth}; }

BeliefRound pure(double belief, Move theirs) { return round_of(belief, theirs, theirs == Move::C ? 1 : 0); }

BeliefConsistency of(const BeliefMatch& match) {
  BeliefConsistency consistency;
  consistency.add(match);
  return consistency;
}

TEST(BeliefConsistency, OfAMatchByHand) {
  const auto c = of({pure(0.25, Move::C), pure(0.75, Move::D), pure(0.5, Move::C), pure(1, Move::C)});
  EXPECT_EQ(c.rounds, 4U);
  EXPECT_EQ(c.largest_distance, 0.75);
  EXPECT_EQ(c.mean_distance(), (0.75 + 0.75 + 0.5 + 0) / 4);
  EXPECT_EQ(c.accuracy(), 0.5);
  EXPECT_NEAR(*c.log_loss(), (std::log(4) + std::log(4) + std::log(2)) / 4, 1e-12);
  EXPECT_EQ(c.brier(), (0.5625 + 0.5625 + 0.25 + 0) / 4);
  EXPECT_EQ(c.wrong_rounds, (std::vector<std::uint64_t>{1, 2}));
  EXPECT_EQ(c.settled_from(), 3U);
  EXPECT_EQ(c.surprises, 0U);
}

TEST(BeliefConsistency, DistanceIsToTheStateNotToTheMove) {
  const auto c = of({round_of(0.7, Move::D, 0.7), round_of(0.7, Move::C, 0.6)});
  EXPECT_NEAR(c.largest_distance, 0.1, 1e-12);
  EXPECT_EQ(c.accuracy(), 0.5);
}

TEST(BeliefConsistency, BinsHoldBeliefsAndWhatCame) {
  const auto c =
      of({pure(0.0, Move::D), pure(0.05, Move::C), pure(0.1, Move::C), pure(0.99, Move::C), pure(1.0, Move::D)});
  EXPECT_EQ(c.bins[0].count, 2U);
  EXPECT_EQ(c.bins[0].mean_belief(), 0.025);
  EXPECT_EQ(c.bins[0].frequency(), 0.5);
  EXPECT_EQ(c.bins[1].count, 1U);
  EXPECT_EQ(c.bins[9].count, 2U);
  EXPECT_EQ(c.bins[9].frequency(), 0.5);
  EXPECT_FALSE(c.bins[5].mean_belief());
  EXPECT_FALSE(c.bins[5].frequency());
}

TEST(BeliefConsistency, ASurpriseIsInfinitelyCostlyAndCounted) {
  const auto c = of({pure(1, Move::D), pure(0.5, Move::C)});
  EXPECT_EQ(c.surprises, 1U);
  EXPECT_TRUE(std::isinf(*c.log_loss()));
  EXPECT_GT(*c.log_loss(), 0);
}

TEST(BeliefConsistency, ThereIsNoneWithoutBeliefs) {
  const auto c = of({{Move::C, Move::C, std::nullopt, 1}});
  EXPECT_EQ(c.rounds, 0U);
  EXPECT_FALSE(c.mean_distance());
  EXPECT_FALSE(c.accuracy());
  EXPECT_FALSE(c.log_loss());
  EXPECT_FALSE(c.brier());
  EXPECT_FALSE(c.settled_from());
}

TEST(BeliefConsistency, NeverSettlesWhenTheLastIsWrong) {
  EXPECT_FALSE(of({pure(1, Move::C), pure(0.6, Move::D)}).settled_from());
  EXPECT_EQ(of({pure(1, Move::C), pure(0.6, Move::C)}).settled_from(), 1U);
  EXPECT_EQ(of({{Move::C, Move::C, std::nullopt, 1}, pure(0.6, Move::C)}).settled_from(), 2U);
}

TEST(BeliefConsistency, OfManyIsThatOfAllTheirRounds) {
  const BeliefMatch first{pure(0.25, Move::C), pure(0.75, Move::C), pure(0.75, Move::C)};
  const BeliefMatch second{pure(0.75, Move::C), pure(0.5, Move::D), pure(0.75, Move::C)};
  auto merged = of(first);
  merged += of(second);
  EXPECT_EQ(merged.matches, 2U);
  EXPECT_EQ(merged.rounds, 6U);
  EXPECT_EQ(merged.right, 4U);
  EXPECT_EQ(merged.largest_distance, 0.75);
  EXPECT_EQ(merged.wrong_rounds, (std::vector<std::uint64_t>{1, 2}));
  EXPECT_EQ(merged.settled_from(), 3U);
  const auto record = belief_consistency({"somebody", false, {first, second}});
  EXPECT_EQ(record.rounds, merged.rounds);
  EXPECT_EQ(record.brier(), merged.brier());
  merged += of({pure(0.25, Move::C)});
  EXPECT_FALSE(merged.settled_from()) << "one of them ends wrong";
}

TEST(BeliefConsistency, RefusesWhatIsNoProbability) {
  EXPECT_THROW(of({pure(1.5, Move::C)}), std::logic_error);
  EXPECT_THROW(of({pure(std::nan(""), Move::C)}), std::logic_error);
}

}  // namespace
}  // namespace folk
