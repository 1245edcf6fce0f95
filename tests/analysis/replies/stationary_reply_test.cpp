#include "analysis/play/naive.h"
#include "analysis/replies/value_iteration.h"

#include <folk/analysis/play/markov_play.h>
#include <folk/analysis/replies/flow.h>
#include <folk/analysis/replies/markov_reply.h>
#include <folk/analysis/replies/stationary_reply.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace folk {
namespace {

constexpr std::array payoff_texts{"T=5,R=3,P=1,S=0", "T=2.5,R=1/3,P=-1,S=-7/2", "T=4,R=3,P=1,S=0"};
constexpr std::array stationary_criteria{
    "discounted:0.3",         "discounted:2/3", "discounted:0.9", "discounted:1e-9",
    "discounted:0.999999999", "ending:1",       "ending:0.2",     "mean"};

Payoffs random_payoffs(RandomStream& random) { return parse_payoffs(payoff_texts[random() % payoff_texts.size()]); }

/// Every stationary way to play against a machine: bit s of a number says what is played in state s.
std::vector<Move> policy_of(std::size_t number, std::size_t states) {
  std::vector<Move> moves;
  for (std::size_t s = 0; s < states; ++s) moves.push_back(move_from_bit(static_cast<unsigned>(number >> s)));
  return moves;
}

/// What a stationary reply earns a deterministic machine's opponent, exactly.
Rational exactly(const Automaton& opponent, const std::vector<Move>& moves, const Payoffs& payoffs,
                 const Criterion& criterion) {
  std::vector<std::uint32_t> next;
  std::vector<double> rewards;
  for (std::size_t s = 0; s < opponent.size(); ++s) {
    const Move theirs = opponent.nodes()[s].cooperation == 1 ? Move::C : Move::D;
    next.push_back(opponent.nodes()[s].next[Outcome{theirs, moves[s]}.index()]);
    rewards.push_back(to_double(Rational(payoffs.by_outcome()[Outcome{moves[s], theirs}.index()] * 6)));
  }
  return Flow(next, rewards, 6, criterion).value(static_cast<std::uint32_t>(opponent.start()));
}

TEST(StationaryReply, IsTheBestOfAllStationaryRepliesTo3000PureMachinesOfUpTo5States) {
  RandomStream random({11, 0, 0, 0});
  for (int i = 0; i < 3000; ++i) {
    const Automaton opponent = test::random_automaton(random, 5, true);
    const Payoffs payoffs = random_payoffs(random);
    const auto criterion = Criterion::parse(stationary_criteria[random() % stationary_criteria.size()]);
    const auto reply = stationary_reply(reply_problem(opponent, payoffs), criterion);
    Rational best = exactly(opponent, policy_of(0, opponent.size()), payoffs, criterion);
    for (std::size_t policy = 1; policy < std::size_t{1} << opponent.size(); ++policy)
      best = std::max(best, exactly(opponent, policy_of(policy, opponent.size()), payoffs, criterion));
    ASSERT_TRUE(reply.optimum);
    ASSERT_EQ(*reply.optimum, best) << criterion.to_string() << " " << to_text(payoffs);
    ASSERT_EQ(exactly(opponent, reply.moves, payoffs, criterion), best);
    ASSERT_NEAR(reply.values[opponent.start()], to_double(best), 1e-7 * criterion.total_weight());
  }
}

/// What the same replies earn on average against a machine that mixes or slips.
double on_average(const Automaton& opponent, const std::vector<Move>& moves, const Payoffs& payoffs,
                  const Criterion& criterion, double noise) {
  std::vector<Automaton::Node> nodes;
  for (std::size_t s = 0; s < opponent.size(); ++s) {
    const auto& next = opponent.nodes()[s].next;
    nodes.push_back({moves[s] == Move::C ? 1.0 : 0.0, {next[0], next[2], next[1], next[3]}});
  }
  const Automaton own(std::move(nodes), static_cast<std::uint32_t>(opponent.start()));
  const auto pair = play_markov(own, opponent, noise, criterion);
  double sum = 0;
  for (std::size_t o = 0; o < 4; ++o) sum += pair->weights[o] * payoffs.numbers()[o];
  return sum;
}

/// A machine of which some states mix, some never end and some are never left: means of several recurrent classes.
Automaton half_random(RandomStream& random, std::uint32_t most) {
  const Automaton mixing = test::random_automaton(random, most, false);
  std::vector<Automaton::Node> nodes = mixing.nodes();
  for (std::uint32_t s = 0; s < nodes.size(); ++s) {
    if (random() % 2 == 0) nodes[s].cooperation = static_cast<double>(random() % 3) / 2;
    if (random() % 3 == 0) nodes[s].next = {s, s, s, s};
  }
  return Automaton(std::move(nodes), static_cast<std::uint32_t>(mixing.start()));
}

TEST(StationaryReply, IsTheBestOfAllStationaryRepliesTo1500MachinesThatMixOrSlip) {
  RandomStream random({12, 0, 0, 0});
  for (int i = 0; i < 1500; ++i) {
    const Automaton opponent = half_random(random, 4);
    const Payoffs payoffs = random_payoffs(random);
    const auto criterion = Criterion::parse(stationary_criteria[random() % stationary_criteria.size()]);
    constexpr std::array noises{0.0, 0.0, 0.05, 1e-6, 1.0};
    const double noise = noises[random() % noises.size()];
    const auto problem = reply_problem(opponent, payoffs, noise);
    const auto reply = markov_reply(problem, criterion);
    double best = -std::numeric_limits<double>::infinity();
    for (std::size_t policy = 0; policy < std::size_t{1} << opponent.size(); ++policy)
      best = std::max(best, on_average(opponent, policy_of(policy, opponent.size()), payoffs, criterion, noise));
    const double value = reply.values[opponent.start()];
    const double rounding = 1e-11 * criterion.total_weight();
    ASSERT_LE(best, value + reply.residual + rounding) << criterion.to_string() << " noise " << noise << " case " << i;
    ASSERT_NEAR(on_average(opponent, reply.moves, payoffs, criterion, noise), value, reply.residual + rounding)
        << criterion.to_string() << " noise " << noise << " case " << i;
    ASSERT_LE(reply.residual, 1e-4 * criterion.total_weight());
  }
}

TEST(StationaryReply, EqualsValueIterationIn1000RandomProblems) {
  RandomStream random({13, 0, 0, 0});
  for (int i = 0; i < 1000; ++i) {
    const bool pure = random() % 2 == 0;
    const Automaton opponent = test::random_automaton(random, 8, pure);
    const Payoffs payoffs = random_payoffs(random);
    constexpr std::array criteria{"discounted:0.3", "discounted:0.9", "ending:0.2", "ending:1"};
    const auto criterion = Criterion::parse(criteria[random() % criteria.size()]);
    const double noise = random() % 2 == 0 ? 0 : random.uniform();
    const auto reply = stationary_reply(reply_problem(opponent, payoffs, noise), criterion);
    const auto values = test::reply_values(opponent, payoffs, criterion, noise);
    for (std::size_t s = 0; s < values.size(); ++s) ASSERT_NEAR(reply.values[s], values[s], 1e-10);
  }
}

TEST(StationaryReply, TakesTheBetterOfTwoCyclesUnderTheMean) {
  // From the start C leads to a machine that defects for ever, D to one that cooperates for ever.
  const Automaton opponent({{1, {1, 2, 1, 2}}, {0, {1, 1, 1, 1}}, {1, {2, 2, 2, 2}}}, 0);
  const auto reply = stationary_reply(reply_problem(opponent, {}), Criterion::mean());
  EXPECT_EQ(*reply.optimum, 5);
  EXPECT_EQ(reply.moves, (std::vector{Move::D, Move::D, Move::D}));
  EXPECT_EQ(reply.exact_means, (std::vector<Rational>{5, 1, 5}));
}

TEST(StationaryReply, FindsACycleOfSeveralRoundsThatPaysMoreThanAnyOfOne) {
  // Forgives after one C: alternating D and C earns (5 + 0) / 2 = 2.5, C alone 3, at R = 2 the other way round.
  const Automaton tit_for_tat({{1, {0, 1, 0, 1}}, {0, {0, 1, 0, 1}}}, 0);
  const auto at = [&](const char* payoffs) {
    return *stationary_reply(reply_problem(tit_for_tat, parse_payoffs(payoffs)), Criterion::mean()).optimum;
  };
  EXPECT_EQ(at("T=5,R=3,P=1,S=0"), 3);
  EXPECT_EQ(at("T=5,R=2,P=1,S=0"), Rational(5, 2));
  EXPECT_EQ(at("T=4,R=2,P=1,S=0"), 2);  // a tie of both
}

TEST(StationaryReply, EndsWherePoliciesTieAndPatienceIsExtreme) {
  RandomStream random({14, 0, 0, 0});
  for (const char* text : {"discounted:0.999999999999", "ending:1e-12", "discounted:1e-300", "mean"})
    for (int i = 0; i < 60; ++i) {
      const Automaton opponent = half_random(random, 8);
      for (const double noise : {0.0, 1e-12, 1e-3}) {
        const auto reply = stationary_reply(reply_problem(opponent, {}, noise), Criterion::parse(text));
        ASSERT_GE(reply.residual, 0);
        ASSERT_TRUE(std::isfinite(reply.values[opponent.start()])) << text << " " << noise;
      }
    }
}

TEST(StationaryReply, OfFiniteCriteriaIsRefused) {
  const Automaton all_c({{1, {0, 0, 0, 0}}}, 0);
  EXPECT_THROW(stationary_reply(reply_problem(all_c, {}), Criterion::finite(3)), std::logic_error);
}

}  // namespace
}  // namespace folk
