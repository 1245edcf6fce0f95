#include "analysis/play/naive.h"
#include "csv.h"

#include <folk/analysis/play/deterministic_play.h>
#include <folk/analysis/replies/finite_best_reply.h>
#include <folk/games/error.h>
#include <folk/strategies/registry.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

namespace folk {
namespace {

/// What these moves earn against a deterministic machine.
double total_of(const std::vector<Move>& moves, const Machine& opponent, const Payoffs& payoffs = {}) {
  const auto by_outcome = payoffs.by_outcome();
  Rational total = 0;
  State state = opponent.start();
  for (const Move own : moves) {
    const Move theirs = move_of(opponent, state);
    total += by_outcome[Outcome{own, theirs}.index()];
    state = opponent.next(state, theirs, own);
  }
  return to_double(total);
}

/// The largest expected total over all plans, with the sign turned the least; own moves and histories spelt out.
double by_recursion(const Machine& opponent, State state, unsigned left, double sign) {
  if (left == 0) return 0;
  constexpr std::array<double, 4> payoffs{3, 0, 5, 1};
  const double p = opponent.cooperation(state);
  double best = -1e9;
  for (const Move own : {Move::C, Move::D}) {
    double value = 0;
    for (const Move theirs : {Move::C, Move::D}) {
      const double chance = theirs == Move::C ? p : 1 - p;
      if (chance == 0) continue;
      const State next = opponent.next(state, theirs, own);
      value += chance * (sign * payoffs[Outcome{own, theirs}.index()] + by_recursion(opponent, next, left - 1, sign));
    }
    best = std::max(best, value);
  }
  return best;
}

TEST(FiniteBestReply, AgreesWithTheReferenceOver100Rounds) {
  const Registry registry = Registry::standard();
  double classics = 0;
  std::size_t row = 0;
  for (const auto& line : test::read_csv("best_response_17_100.csv")) {
    // A variant of mem2 that Folk does not name.
    if (row++ == 0 || line[0] == "mem2_paysum") continue;
    const auto machine = registry.make(line[0]).machine;
    const FiniteBestReply reply(*machine, {}, 100);
    EXPECT_EQ(reply.optimum(), std::stod(line[1])) << line[0];
    EXPECT_EQ(reply.minimum(), std::stod(line[2])) << line[0];
    EXPECT_EQ(total_of(reply.moves(), *machine), reply.optimum()) << line[0];
    std::vector<Move> golden;
    for (const char move : line[6]) golden.push_back(move == 'C' ? Move::C : Move::D);
    EXPECT_EQ(total_of(golden, *machine), reply.optimum()) << line[0];
    // Played as a machine, the reply earns the optimum.
    const Automaton replier = reply.machine();
    const PairResult match = play_deterministic(replier, *machine, Criterion::finite(100));
    double earned = 0;
    for (std::size_t o = 0; o < 4; ++o) earned += match.weights[o] * Payoffs{}.numbers()[o];
    EXPECT_EQ(earned, reply.optimum()) << line[0];
    if (row <= 18) classics += reply.optimum();
  }
  EXPECT_EQ(row, 20U);
  EXPECT_EQ(classics, 5517);
}

RC_GTEST_PROP(FiniteBestReply, EqualsTheBestOfAllPlans, ()) {
  RandomStream random({*rc::gen::arbitrary<std::uint64_t>(), 0, 0, 0});
  const unsigned rounds = 1 + static_cast<unsigned>(random() % 6);
  const bool pure = random() % 2 == 0;
  const Automaton opponent = test::random_automaton(random, 5, pure);
  const FiniteBestReply reply(opponent, {}, rounds);
  RC_ASSERT(std::abs(reply.optimum() - by_recursion(opponent, opponent.start(), rounds, 1)) <= 1e-12);
  RC_ASSERT(std::abs(reply.minimum() + by_recursion(opponent, opponent.start(), rounds, -1)) <= 1e-12);
  if (pure) RC_ASSERT(total_of(reply.moves(), opponent) == reply.optimum());
}

TEST(FiniteBestReply, EarnsTheMeanAgainstAMixer) {
  const auto random = Registry::standard().make("random(0.25)").machine;
  const FiniteBestReply reply(*random, {}, 10);
  EXPECT_DOUBLE_EQ(reply.optimum(), 10 * (0.25 * 5 + 0.75 * 1));
  EXPECT_DOUBLE_EQ(reply.minimum(), 10 * (0.25 * 3));
  EXPECT_EQ(reply.best(0, 0), Move::D);
  EXPECT_THROW(reply.moves(), std::logic_error);
}

TEST(FiniteBestReply, PlaysCWherePayoffsOfFractionsTie) {
  const auto tit_for_tat = Registry::standard().make("tit_for_tat").machine;
  // C, C, D earns 2R + T, and D, C, D earns 2T + S: the same exactly, though not in sums of doubles.
  const FiniteBestReply reply(*tit_for_tat, parse_payoffs("T=0.6,R=0.3,P=0.1,S=0"), 3);
  EXPECT_EQ(reply.optimum(), 1.2);
  EXPECT_EQ(reply.moves(), (std::vector{Move::C, Move::C, Move::D}));
}

TEST(FiniteBestReply, RefusesWhatItCannotSolve) {
  const auto gradual = Registry::standard().make("gradual").machine;
  EXPECT_THROW(FiniteBestReply(*gradual, {}, 0), UsageError);
  EXPECT_THROW(FiniteBestReply(*gradual, {}, 1'000'000'000'000), UsageError);
  const auto all_c = Registry::standard().make("all_c").machine;
  EXPECT_THROW(FiniteBestReply(*all_c, {}, FiniteBestReply::most_decisions + 1), UsageError);
  EXPECT_THROW(FiniteBestReply(*all_c, parse_payoffs("T=1e20,R=3,P=1,S=0"), 10), UsageError);
}

}  // namespace
}  // namespace folk
