#include "analysis/play/naive.h"
#include "games/ended_work.h"
#include "strategies/named.h"

#include <folk/analysis/equilibria/equilibrium_check.h>
#include <folk/analysis/play/parallel.h>
#include <folk/games/error.h>
#include <folk/strategies/registry.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace folk {
namespace {

using test::named;
PairGaps against_itself(const char* name, const char* criterion, const char* payoffs = "T=5,R=3,P=1,S=0",
                        const char* beliefs = "classics") {
  const auto machine = named(name).machine;
  return pair_gaps(*machine, *machine,
                   {{parse_payoffs(payoffs), Criterion::parse(criterion)}, Registry::standard().roster(beliefs)});
}

Rational nash_gain(const char* name, const char* criterion) {
  return *against_itself(name, criterion).first.nash->exact;
}
Rational perfect(const char* name, const char* criterion, const char* payoffs = "T=5,R=3,P=1,S=0") {
  return *against_itself(name, criterion, payoffs).first.subgame_perfect->exact;
}
Rational confirming(const char* name, const char* criterion) {
  return *against_itself(name, criterion).first.self_confirming_unrestricted->exact;
}

TEST(PairGaps, SpitefulIsSubgamePerfectFromOneHalf) {
  EXPECT_EQ(perfect("spiteful", "discounted:1/2"), 0);
  EXPECT_EQ(perfect("spiteful", "discounted:0.9"), 0);
  // At 0.49 deviating pays (1 - d) 5 + d 1 instead of 3.
  EXPECT_EQ(perfect("spiteful", "discounted:0.49"), Rational(4, 100));
  EXPECT_EQ(nash_gain("spiteful", "discounted:0.49"), Rational(4, 100));
}

TEST(PairGaps, TitForTatIsNashFromTwoThirdsAndNeverPerfect) {
  EXPECT_EQ(nash_gain("tit_for_tat", "discounted:2/3"), 0);
  EXPECT_GT(nash_gain("tit_for_tat", "discounted:0.6666"), 0);
  EXPECT_EQ(nash_gain("tit_for_tat", "discounted:0.99"), 0);
  for (const char* criterion : {"discounted:0.1", "discounted:2/3", "discounted:0.7", "discounted:0.99"})
    EXPECT_GT(perfect("tit_for_tat", criterion), 0) << criterion;
}

TEST(PairGaps, PavlovIsNeverNashYetItsPathIsSelfConfirming) {
  for (const char* criterion : {"discounted:0.1", "discounted:0.5", "discounted:0.9", "discounted:0.999"})
    EXPECT_GT(nash_gain("pavlov", criterion), 0) << criterion;
  EXPECT_EQ(nash_gain("pavlov", "mean"), 0);
  EXPECT_EQ(confirming("pavlov", "discounted:0.5"), 0);
  EXPECT_GT(confirming("pavlov", "discounted:0.499"), 0);
  const auto gaps = against_itself("pavlov", "discounted:0.6");
  ASSERT_TRUE(gaps.first.self_confirming_class);
  EXPECT_EQ(*gaps.first.self_confirming_class->exact, 0);
  EXPECT_EQ(gaps.first.self_confirming_class->witness.belief, "spiteful");
  EXPECT_EQ(perfect("pavlov", "discounted:1/2", "T=4,R=3,P=1,S=0"), 0);
  EXPECT_GT(perfect("pavlov", "discounted:0.4999", "T=4,R=3,P=1,S=0"), 0);
}

TEST(PairGaps, AllDIsEverything) {
  for (const char* criterion : {"discounted:0.01", "discounted:0.99", "finite:100", "mean", "ending:0.1"}) {
    const auto gaps = against_itself("all_d", criterion);
    EXPECT_EQ(*gaps.first.nash->exact, 0) << criterion;
    EXPECT_EQ(*gaps.first.subgame_perfect->exact, 0) << criterion;
    EXPECT_EQ(*gaps.first.self_confirming_unrestricted->exact, 0) << criterion;
    EXPECT_EQ(*gaps.first.self_confirming_class->exact, 0) << criterion;
  }
}

TEST(PairGaps, GrudgerIsNashFromOneHalfAndNeverPerfect) {
  EXPECT_EQ(nash_gain("grudger", "discounted:1/2"), 0);
  EXPECT_GT(nash_gain("grudger", "discounted:0.4999"), 0);
  for (const char* criterion : {"discounted:0.2", "discounted:0.5", "discounted:0.9"})
    EXPECT_GT(perfect("grudger", criterion), 0) << criterion;
}

TEST(PairGaps, CooperationOverRoundsThatEndGains2ByTheLastD) {
  const auto gaps = against_itself("tit_for_tat", "finite:100");
  EXPECT_EQ(*gaps.first.self_confirming_unrestricted->exact, 2);
  EXPECT_EQ(*gaps.first.nash->exact, 2);
  EXPECT_EQ(gaps.first.nash->witness.history.size(), 99U);
  EXPECT_EQ(gaps.first.nash->witness.deviation, Move::D);
}

TEST(PairGaps, OnlyPathsOfDSurviveWhereRoundsEnd) {
  constexpr unsigned rounds = 4;
  for (unsigned moves = 0; moves < 1U << (2 * rounds); ++moves) {
    PlayPath path;
    bool all_d = true;
    for (unsigned t = 0; t < rounds; ++t) {
      path.rounds.push_back({move_from_bit(moves >> (2 * t)), move_from_bit(moves >> (2 * t + 1))});
      all_d = all_d && path.rounds.back() == Outcome{Move::D, Move::D};
    }
    const auto gaps = match_gaps(path, nullptr, nullptr, {{{}, Criterion::finite(rounds)}, {}});
    const bool survives =
        *gaps.first.self_confirming_unrestricted->exact == 0 && *gaps.second.self_confirming_unrestricted->exact == 0;
    EXPECT_EQ(survives, all_d) << moves;
  }
}

TEST(PairGaps, AllCUnderTheMeanIsNotPerfectByOneShotDeviationsAlone) {
  // One deviation never changes a mean, yet all_d against all_c earns 5 instead of 3.
  EXPECT_EQ(perfect("all_c", "mean"), 2);
  EXPECT_EQ(nash_gain("all_c", "mean"), 2);
}

TEST(PairGaps, RefusesMachinesWithoutEndUnderCriteriaWithoutEnd) {
  const auto gradual = named("gradual").machine;
  EXPECT_THROW(pair_gaps(*gradual, *gradual, {{{}, Criterion::discounted(0.9)}, {}}), UsageError);
  EXPECT_THROW(pair_gaps(*gradual, *gradual, {{{}, Criterion::mean()}, {}, 50}), UsageError);
  const auto gaps = pair_gaps(*gradual, *gradual, {{{}, Criterion::discounted(0.9)}, {}, 40});
  ASSERT_TRUE(gaps.first.nash);
  EXPECT_TRUE(gaps.first.nash->depth);
  EXPECT_FALSE(gaps.first.subgame_perfect);
}

TEST(PairGaps, AnEndlessMemberThatIsLeftOutIsABoundAndNamed) {
  // Against soft_majo, C and D in turn earn 4 a round: less is gained than the 2 against all_c.
  const auto gaps = against_itself("all_c", "mean", "T=5,R=3,P=1,S=0", "all_c,soft_majo");
  ASSERT_TRUE(gaps.first.self_confirming_class);
  EXPECT_EQ(gaps.first.self_confirming_class->gain, 0);
  EXPECT_TRUE(gaps.first.self_confirming_class->bounded());
  EXPECT_NE(gaps.first.self_confirming_class->tried.find("soft_majo"), std::string::npos);
  // Another member that gives 0 decides.
  EXPECT_FALSE(
      against_itself("all_c", "mean", "T=5,R=3,P=1,S=0", "soft_majo,spiteful").first.self_confirming_class->bounded());
}

/// Nash implies (a), and (b) implies (a), as numbers; at any criterion, and the chance code agrees with the exact one.
RC_GTEST_PROP(PairGaps, AreOrderedAsTheNotionsAre, ()) {
  RandomStream random({*rc::gen::arbitrary<std::uint64_t>(), 0, 0, 0});
  const bool pure = random() % 2 == 0;
  const Automaton first = test::random_automaton(random, 4, pure);
  const Automaton second = test::random_automaton(random, 4, pure);
  constexpr std::array criteria{"finite:1", "finite:7", "discounted:0.3", "discounted:0.9", "mean", "ending:0.2"};
  EquilibriumQuestion question{{{}, Criterion::parse(criteria[random() % criteria.size()])}, {}, 0};
  for (int i = 0; i < 3; ++i) {
    Strategy member{"member", std::make_shared<Automaton>(test::random_automaton(random, 3, pure)), {}};
    question.beliefs.push_back(std::move(member));
  }
  question.beliefs.push_back({"truth", std::make_shared<Automaton>(second), {}});
  const auto gaps = pair_gaps(first, second, question).first;
  RC_ASSERT(gaps.nash && gaps.self_confirming_unrestricted && gaps.self_confirming_class);
  constexpr double rounding = 1e-9;
  RC_ASSERT(gaps.self_confirming_unrestricted->gain <= gaps.nash->gain + rounding);
  RC_ASSERT(gaps.self_confirming_unrestricted->gain <= gaps.self_confirming_class->gain + rounding);
  RC_ASSERT(gaps.self_confirming_class->gain <= gaps.nash->gain + rounding);
  if (gaps.subgame_perfect && gaps.subgame_perfect->gain <= rounding &&
      pair_gaps(second, first, question).first.subgame_perfect->gain <= rounding)
    RC_ASSERT(gaps.nash->gain <= 1e-6);
}

TEST(PairGaps, EndAsTheirProgressWishes) {
  const auto classics = Registry::standard().roster("classics");
  for (const char* name : {"pavlov", "random(0.3)"}) {
    const auto own = named(name).machine;
    const auto theirs = named("tit_for_tat").machine;
    const EquilibriumQuestion question{{{}, Criterion::finite(10)}, classics};
    test::expect_ends([&](const Progress& progress) {
      EXPECT_TRUE(pair_gaps(*own, *theirs, question, progress).second.self_confirming_unrestricted);
    });
  }
}

// As an examination of many pairs asks: each thread its own questions, one progress over all of them.
TEST(PairGapsThreads, EndAsTheirProgressWishes) {
  const auto opponents = Registry::standard().roster("all_c,all_d,pavlov,tit_for_tat,spiteful,per_ccd");
  const auto own = named("pavlov").machine;
  const EquilibriumQuestion question{{{}, Criterion::finite(10)}, opponents};
  for (const unsigned threads : {1U, 4U})
    test::expect_ends([&](const Progress& progress) {
      const Progress cancels{nullptr, [&] { return progress.cancelled(); }};
      const auto ask = [&](std::size_t i, unsigned) { pair_gaps(*own, *opponents[i].machine, question, cancels); };
      parallel_for(opponents.size(), threads, ask, progress);
    });
}

}  // namespace
}  // namespace folk
