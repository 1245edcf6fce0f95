#include <folk/games/outcome.h>
#include <folk/games/payoffs.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "games/arbitrary.h"
#include "games/expect_error.h"

namespace folk {
namespace {

using test::expect_error;

TEST(Payoffs, ReadsLettersInAnyOrder) {
  EXPECT_EQ(parse_payoffs("T=5,R=3,P=1,S=0"), Payoffs{});
  EXPECT_EQ(parse_payoffs("S=0,P=1,R=3,T=5"), Payoffs{});
  EXPECT_EQ(parse_payoffs("T=1.5,R=1,P=1/3,S=-2e-1"), (Payoffs{{3, 2}, 1, {1, 3}, {-1, 5}}));
}

TEST(Payoffs, OutcomesAreInOrder) {
  const auto by_outcome = Payoffs{}.by_outcome();
  EXPECT_EQ((by_outcome[Outcome{Move::C, Move::C}.index()]), 3);
  EXPECT_EQ((by_outcome[Outcome{Move::C, Move::D}.index()]), 0);
  EXPECT_EQ((by_outcome[Outcome{Move::D, Move::C}.index()]), 5);
  EXPECT_EQ((by_outcome[Outcome{Move::D, Move::D}.index()]), 1);
}

TEST(Payoffs, RefusesTextsThatAreNoPayoffs) {
  const auto parse = [](std::string_view text) { return [text] { parse_payoffs(text); }; };
  expect_error<UsageError>(parse(""), "T is missing; write T=5,R=3,P=1,S=0");
  expect_error<UsageError>(parse("T=5,R=3,P=1"), "S is missing");
  expect_error<UsageError>(parse("T=5,R=3,P=1,S=0,T=5"), "T is given twice");
  expect_error<UsageError>(parse("T=5,R=3,P=1,S=0,"), "it ends with a comma");
  expect_error<UsageError>(parse("T=5,,R=3,P=1,S=0"), "'' is not a letter of T, R, P, S with a value");
  expect_error<UsageError>(parse("T=5,R=3,P=1,X=0"), "'X=0' is not a letter");
  expect_error<UsageError>(parse("T=5,R=3,P=1,S="), "'S=' is not a letter");
  expect_error<UsageError>(parse("5,3,1,0"), "'5' is not a letter");
  expect_error<UsageError>(parse("T=5,R=3,P=1,S=zero"), "S: 'zero' is not a number");
  expect_error<UsageError>(parse("T=nan,R=3,P=1,S=0"), "T: 'nan' is not a number");
  expect_error<UsageError>(parse("T=5,R=3,P=1,S=0\n"), "'0?' is not a number");
  expect_error<UsageError>(parse("T=inf,R=3,P=1,S=0"), "not a number");
}

TEST(Payoffs, RefusesWhatIsNoDilemma) {
  for (const char* text : {"T=3,R=5,P=1,S=0", "T=5,R=1,P=3,S=0", "T=5,R=3,P=0,S=1", "T=5,R=5,P=1,S=0",
                           "T=5,R=3,P=3,S=0", "T=5,R=3,P=1,S=1", "T=0,R=0,P=0,S=0"})
    expect_error<UsageError>([&] { parse_payoffs(text); }, "it needs T > R > P > S");
}

TEST(Payoffs, OfOtherGamesAreReadAndNamed) {
  const auto named = [](const char* text) { return usual_name(parse_symmetric_payoffs(text)); };
  EXPECT_EQ(parse_symmetric_payoffs("T=3,R=4,S=0,P=2"), (Payoffs{3, 4, 2, 0}));
  EXPECT_THROW(parse_symmetric_payoffs("T=3,R=4,S=0"), UsageError);
  EXPECT_EQ(named("T=5,R=3,P=1,S=0"), "prisoner's dilemma");
  EXPECT_EQ(named("T=8,R=9,P=7,S=0"), "stag hunt");
  EXPECT_EQ(named("T=3,R=4,P=3,S=0"), "stag hunt");
  EXPECT_EQ(named("T=7,R=6,P=0,S=2"), "chicken");
  for (const char* other :
       {"T=1,R=2,P=3,S=4", "T=5,R=3,P=1,S=1", "T=3,R=4,P=0,S=0", "T=4,R=3,P=0,S=3", "T=3,R=3,P=1,S=0"})
    EXPECT_EQ(named(other), "symmetric 2x2 game") << other;
}

TEST(Payoffs, WarnsWhenTakingTurnsPays) {
  EXPECT_FALSE(dilemma_warning(Payoffs{}));
  EXPECT_TRUE(dilemma_warning(prisoners_dilemma(6, 3, 1, 0)));  // 2R = T + S
  EXPECT_TRUE(dilemma_warning(prisoners_dilemma(7, 3, 1, 0)));
  EXPECT_FALSE(dilemma_warning(prisoners_dilemma({599, 100}, 3, 1, 0)));
}

RC_GTEST_PROP(Payoffs, TextAndGameAreReadBack, (std::array<Rational, 4> values)) {
  std::sort(values.begin(), values.end());
  RC_PRE(values[0] < values[1] && values[1] < values[2] && values[2] < values[3]);
  const Payoffs payoffs = prisoners_dilemma(values[3], values[2], values[1], values[0]);
  RC_ASSERT(parse_payoffs(to_text(payoffs)) == payoffs);
  const StageGame game = stage_game(payoffs);
  RC_ASSERT(game.is_symmetric());
  RC_ASSERT(symmetric_payoffs(game) == payoffs);
  RC_ASSERT(game.payoff(Seat::first, 1, 0) == payoffs.temptation);
}

TEST(Payoffs, TakesSymmetricTwoByTwoGamesOnly) {
  expect_error<UsageError>(
      [] {
        symmetric_payoffs(StageGame("BoS", {}, {{{"a", "b"}, {"a", "b"}}}, {{2, 1}, {0, 0}, {0, 0}, {1, 2}}));
      },
      "'BoS' is not symmetric");
  expect_error<UsageError>([] { symmetric_payoffs(StageGame("one", {}, {{{"a"}, {"a"}}}, {{2, 2}})); }, "is 1x1");
}

}  // namespace
}  // namespace folk
