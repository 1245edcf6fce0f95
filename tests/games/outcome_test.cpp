#include <folk/games/outcome.h>

#include <gtest/gtest.h>

#include <type_traits>

namespace folk {
namespace {

static_assert(std::is_trivially_copyable_v<Outcome>);
static_assert(sizeof(Outcome) == 2);

TEST(Outcome, IndicesAreTheOrderOfTheLiterature) {
  EXPECT_EQ((Outcome{Move::C, Move::C}.index()), 0U);
  EXPECT_EQ((Outcome{Move::C, Move::D}.index()), 1U);
  EXPECT_EQ((Outcome{Move::D, Move::C}.index()), 2U);
  EXPECT_EQ((Outcome{Move::D, Move::D}.index()), 3U);
  for (std::size_t o = 0; o < all_outcomes.size(); ++o) EXPECT_EQ(all_outcomes[o].index(), o);
}

TEST(Outcome, ExchangedIsWhatTheOtherSees) {
  for (const Outcome outcome : all_outcomes) {
    EXPECT_EQ(outcome.exchanged(), (Outcome{outcome.theirs, outcome.own}));
    EXPECT_EQ(outcome.exchanged().exchanged(), outcome);
  }
  EXPECT_EQ((Outcome{Move::C, Move::D}.exchanged().index()), 2U);
}

TEST(Outcome, DeviatingChangesTheOwnMoveAlone) {
  for (const Outcome outcome : all_outcomes) {
    EXPECT_NE(outcome.deviated().own, outcome.own);
    EXPECT_EQ(outcome.deviated().theirs, outcome.theirs);
    EXPECT_EQ(outcome.deviated().deviated(), outcome);
  }
}

}  // namespace
}  // namespace folk
