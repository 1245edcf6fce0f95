#include "analysis/play/naive.h"
#include "analysis/replies/value_iteration.h"

#include <folk/analysis/play/markov_play.h>
#include <folk/analysis/replies/best_reply.h>
#include <folk/games/error.h>
#include <folk/strategies/registry.h>
#include <gtest/gtest.h>

#include <cmath>

namespace folk {
namespace {

double earned(const Automaton& own, const Automaton& theirs, double noise, const Criterion& criterion,
              const Payoffs& payoffs) {
  const auto pair = play_markov(own, theirs, noise, criterion);
  double sum = 0;
  for (std::size_t o = 0; o < 4; ++o) sum += pair->weights[o] * payoffs.numbers()[o];
  return sum;
}

TEST(BestReply, EarnsItsPayoffWhenItIsPlayedAgainst2000RandomMachines) {
  RandomStream random({21, 0, 0, 0});
  constexpr std::array criteria{"finite:1",       "finite:9",   "finite:30", "discounted:0.4",
                                "discounted:0.9", "ending:0.1", "ending:1",  "mean"};
  constexpr std::array noises{0.0, 0.0, 0.02, 0.5, 1.0};
  for (int i = 0; i < 2000; ++i) {
    const Automaton opponent = test::random_automaton(random, 8, random() % 2 == 0);
    const auto criterion = Criterion::parse(criteria[random() % criteria.size()]);
    const double noise = noises[random() % noises.size()];
    const Payoffs payoffs = parse_payoffs(random() % 2 == 0 ? "T=5,R=3,P=1,S=0" : "T=2.5,R=1/3,P=-1,S=-7/2");
    const BestReply reply = best_reply(opponent, {payoffs, criterion, noise});
    ASSERT_NEAR(earned(reply.machine, opponent, noise, criterion, payoffs), reply.payoff, 1e-9)
        << criterion.to_string() << " noise " << noise << " case " << i;
    ASSERT_EQ(reply.exact.has_value(), opponent.deterministic() && noise == 0);
    if (reply.exact) {
      ASSERT_NEAR(to_double(*reply.exact), reply.payoff, 1e-10);
    }
  }
}

TEST(BestReply, ToTitForTatIsKnown) {
  const auto tit_for_tat = Registry::standard().make("tit_for_tat").machine;
  const auto exactly = [&](const char* criterion) {
    return *best_reply(*tit_for_tat, {{}, Criterion::parse(criterion)}).exact;
  };
  EXPECT_EQ(exactly("finite:1"), 5);
  EXPECT_EQ(exactly("finite:10"), 9 * 3 + 5);
  EXPECT_EQ(exactly("discounted:2/3"), 3);
  // Below 2/3 turns of D and C earn (T + d S) / (1 + d), below 1/4 D for ever (1 - d) T + d P.
  EXPECT_EQ(exactly("discounted:0.5"), 5 / Rational(3, 2));
  EXPECT_EQ(exactly("discounted:0.1"), Rational(46, 10));
  EXPECT_EQ(exactly("mean"), 3);
  EXPECT_EQ(exactly("ending:1"), 5);
}

TEST(BestReply, CountsTotalsOfFractionsExactly) {
  // 2^51 times the payoffs' denominator: doubles of the total in units of 1 no longer know its last digit.
  const Automaton all_c({{1, {0, 0, 0, 0}}}, 0);
  const Payoffs payoffs = parse_payoffs("T=1000000000000.1,R=3,P=1,S=0");
  EXPECT_EQ(*best_reply(all_c, {payoffs, Criterion::finite(800)}).exact, parse_rational("800000000000080"));
  const Payoffs tiny = parse_payoffs("T=5e-30,R=3e-30,P=1e-30,S=0");
  EXPECT_EQ(*best_reply(all_c, {tiny, Criterion::finite(3)}).exact, parse_rational("15e-30"));
  EXPECT_EQ(*best_reply(all_c, {tiny, Criterion::discounted(0.9)}).exact, parse_rational("5e-30"));
  EXPECT_EQ(*best_reply(all_c, {tiny, Criterion::mean()}).exact, parse_rational("5e-30"));
}

TEST(BestReply, ToMachinesWithoutEndIsALowerBoundThatRisesWithTheHorizon) {
  const auto gradual = Registry::standard().make("gradual").machine;
  double before = 0;
  for (const unsigned horizon : {5U, 20U, 80U}) {
    const BestReply reply = best_reply(*gradual, {{}, Criterion::discounted(0.9)}, horizon);
    EXPECT_EQ(reply.horizon, horizon);
    EXPECT_GE(reply.payoff, before);
    before = reply.payoff;
  }
  EXPECT_THROW(best_reply(*gradual, {{}, Criterion::discounted(0.9)}), UsageError);
  EXPECT_THROW(best_reply(*gradual, {{}, Criterion::mean()}, 50), UsageError);
  EXPECT_EQ(best_reply(*gradual, {{}, Criterion::finite(20)}).horizon, std::nullopt);
  EXPECT_THROW(best_reply(*gradual, {{}, Criterion::finite(20), -0.1}), UsageError);
  EXPECT_THROW(best_reply(*gradual, {{}, Criterion::finite(20), std::nan("")}), UsageError);
}

}  // namespace
}  // namespace folk
