// The best memory-one reply found: against published figures, exact best replies and grids.

#include "analysis/play/naive.h"
#include "cases.h"
#include "games/ended_work.h"
#include "games/expect_error.h"

#include <folk/analysis/play/criterion_table.h>
#include <folk/analysis/replies/best_reply.h>
#include <folk/analysis/replies/memory_one_reply.h>
#include <folk/strategies/memory_one.h>
#include <folk/strategies/registry.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

namespace folk {
namespace {

const Criterion long_run = Criterion::mean();

/// A population of memory-one strategies by their four probabilities; they open with C.
WeightedOpponents of(const std::vector<std::array<double, 4>>& opponents, const Criterion& criterion,
                     double noise = 0) {
  std::vector<WeightedOpponent> members;
  for (const auto& after : opponents) members.push_back({memory_one(1, after), 1});
  return {std::move(members), {{}, criterion, noise}};
}

WeightedOpponents named(const std::string& roster, const Criterion& criterion, double noise = 0) {
  std::vector<WeightedOpponent> members;
  for (const auto& strategy : Registry::standard().roster(roster))
    members.push_back({table_for(*strategy.machine, criterion, Sense::any_own_moves, 0), 1});
  return {std::move(members), {{}, criterion, noise}};
}

std::array<double, 4> random_four(RandomStream& random) {
  std::array<double, 4> p{};
  for (double& x : p) x = random.uniform();
  return p;
}

/// The best of a grid of `steps` intervals about a centre, for both openings, made finer `rounds` times.
double best_on_grids(const WeightedOpponents& population, int steps, int rounds) {
  double best = -1e9;
  for (const Move opening : {Move::C, Move::D}) {
    std::array<double, 4> low{0, 0, 0, 0};
    std::array<double, 4> high{1, 1, 1, 1};
    for (int round = 0; round < rounds; ++round) {
      double highest = -1e9;
      std::array<double, 4> at{};
      std::array<int, 4> i{};
      for (i[0] = 0; i[0] <= steps; ++i[0])
        for (i[1] = 0; i[1] <= steps; ++i[1])
          for (i[2] = 0; i[2] <= steps; ++i[2])
            for (i[3] = 0; i[3] <= steps; ++i[3]) {
              std::array<double, 4> p{};
              for (std::size_t k = 0; k < 4; ++k) p[k] = low[k] + (high[k] - low[k]) * i[k] / steps;
              const double value = population.payoff({opening, p});
              if (value > highest) {
                highest = value;
                at = p;
              }
            }
      best = std::max(best, highest);
      for (std::size_t k = 0; k < 4; ++k) {
        const double reach = (high[k] - low[k]) / steps;
        low[k] = std::max(0.0, at[k] - reach);
        high[k] = std::min(1.0, at[k] + reach);
      }
    }
  }
  return best;
}

TEST(MemoryOnePayoff, IsWhatGlynatsiAndKnightPrint) {
  // Their example that the payoff is not concave (figures cut off after three digits), against (1/3, 1/3, 1/3, 1/3).
  const auto third = of({{1. / 3, 1. / 3, 1. / 3, 1. / 3}}, long_run);
  EXPECT_NEAR(third.payoff({Move::C, {0.25, 0.5, 0.2, 0.5}}), 1.790, 1e-3);
  EXPECT_NEAR(third.payoff({Move::C, {0.8, 0.5, 0.9, 0.7}}), 1.457, 1e-3);
  EXPECT_NEAR(third.payoff({Move::C, {0.745, 0.5, 0.83, 0.68}}), 1.485, 1e-3);
}

TEST(MemoryOneReply, EarnsNoLessThanTheirBestReactiveReply) {
  // The test of their program draws the opponent from NumPy's generator with seed 2933, and finds that the best reply
  // by the opponent's last move alone is (0, 0.42680), which earns 2.65469.
  std::mt19937 generator(2933);
  std::array<double, 4> opponent{};
  for (double& q : opponent) {
    const auto high = generator() >> 5U;
    const auto low = generator() >> 6U;
    q = (static_cast<double>(high) * 67108864.0 + static_cast<double>(low)) / 9007199254740992.0;
  }
  const auto population = of({opponent}, long_run);
  constexpr double second = 0.4267968584197451;
  EXPECT_NEAR(population.payoff({Move::C, {0, second, 0, second}}), 2.6546912335393573, 1e-9);
  const auto reply = memory_one_reply(population);
  EXPECT_GE(reply.payoff, 2.6546912335393573);
  EXPECT_NEAR(reply.payoff, reply.certificate.unrestricted, 1e-9);
}

TEST(MemoryOneReply, ToOneMemoryOneOpponentIsADeterministicOne) {
  // Its state is the last round's outcome: a stationary reply on its states is a deterministic memory-one strategy.
  RandomStream random({4, 1, 0, 0});
  for (int trial = 0; trial < 6; ++trial) {
    const auto opponent = random_four(random);
    for (const char* criterion : {"mean", "discounted:0.8", "ending:0.05"})
      for (const double noise : {0.0, 0.02}) {
        const auto reply = memory_one_reply(of({opponent}, Criterion::parse(criterion), noise), {200});
        EXPECT_NEAR(reply.payoff, reply.certificate.unrestricted, 1e-9 * std::max(1.0, reply.payoff)) << criterion;
        EXPECT_EQ(reply.payoff, reply.certificate.corner_payoff);
        for (const double p : reply.strategy.after) EXPECT_TRUE(p == 0 || p == 1);
        EXPECT_LT(reply.certificate.slope, 1e-5);
      }
  }
}

TEST(MemoryOneReply, ToAPairEarnsWhatAFineGridFinds) {
  RandomStream random({4, 2, 0, 0});
  int mixed = 0;
  for (int trial = 0; trial < 4; ++trial) {
    // Near the corners, where compromises between the two pay.
    std::vector<std::array<double, 4>> pair{random_four(random), random_four(random)};
    for (auto& member : pair)
      for (double& p : member) p = std::round(p) * 0.9 + 0.05;
    const auto population = of(pair, trial % 2 == 0 ? long_run : Criterion::discounted(0.9));
    const auto reply = memory_one_reply(population);
    const double grid = best_on_grids(population, 6, 7);
    EXPECT_GE(reply.payoff, grid - 1e-9);
    EXPECT_NEAR(reply.payoff, grid, 2e-3);  // a grid can miss the hill that the search finds
    EXPECT_LE(reply.payoff, reply.certificate.unrestricted + 1e-9);
    EXPECT_LT(reply.certificate.slope, 1e-4);
    EXPECT_EQ(reply.payoff, population.payoff(reply.strategy));
    mixed += reply.payoff > reply.certificate.corner_payoff + 1e-6 ? 1 : 0;
  }
  EXPECT_GT(mixed, 0);
}

TEST(MemoryOneReply, SeesWhatOnlyAFaceEarns) {
  // Against grim any chance of a D ends in D for ever: only pCC = 1 keeps cooperation, and no inner point shows it.
  const auto reply = memory_one_reply(named("spiteful", long_run));
  EXPECT_EQ(reply.payoff, 3);
  EXPECT_EQ(reply.strategy.opening, Move::C);
  EXPECT_EQ(reply.strategy.after[0], 1);
  EXPECT_NEAR(reply.certificate.unrestricted, 3, 1e-12);
}

TEST(MemoryOneReply, StopsShortOfASupremumThatIsNotReached) {
  // It plays C and D in turn until the other answers its C with C and then plays D, once; from then on it cooperates
  // but has each D punished for three rounds. The D that is needed once must be played after CC and by chance: the
  // smaller its probability the better, but never 0.
  const Automaton teacher({{1, {1, 6, 1, 6}},
                           {0, {0, 2, 0, 2}},
                           {1, {2, 3, 2, 3}},
                           {0, {4, 4, 4, 4}},
                           {0, {5, 5, 5, 5}},
                           {0, {2, 2, 2, 2}},
                           {0, {6, 6, 6, 6}}},
                          0);
  const auto reply = memory_one_reply(WeightedOpponents({{teacher, 1}}, {{}, long_run}));
  EXPECT_NEAR(reply.payoff, 3, 1e-6);
  EXPECT_LT(reply.certificate.corner_payoff, 2.5);
  EXPECT_TRUE(reply.certificate.at_open_end);
  EXPECT_NEAR(reply.certificate.unrestricted, 3, 1e-12);
}

TEST(MemoryOneReply, WithFiniteRoundsIsBoundedByTheExactBestReply) {
  const auto reply = memory_one_reply(named("tit_for_tat", Criterion::finite(10)), {100});
  EXPECT_EQ(reply.certificate.unrestricted, 32);  // 9 rounds of C, then D
  EXPECT_GE(reply.payoff, 30);
  EXPECT_LT(reply.payoff, 32);
}

TEST(MemoryOneReply, WeighsItsOpponents) {
  const Automaton all_c = memory_one(1, {1, 1, 1, 1});
  const Automaton grim({{1, {0, 1, 1, 1}}, {0, {1, 1, 1, 1}}}, 0);
  // To defect earns 5w + (1-w), to cooperate 3.
  for (const double weight : {0.4, 0.6}) {
    const auto reply =
        memory_one_reply(WeightedOpponents({{all_c, weight}, {grim, 1 - weight}}, {{}, long_run}), {100});
    EXPECT_NEAR(reply.payoff, std::max(3.0, 5 * weight + (1 - weight)), 1e-6);
    EXPECT_NEAR(reply.certificate.unrestricted, 5 * weight + 3 * (1 - weight), 1e-12);
  }
}

TEST(MemoryOneReply, IsTheSameOnAnyNumberOfThreads) {
  const auto population = of({{0.9, 0.1, 0.6, 0.2}, {0.3, 0.8, 0.1, 0.7}}, Criterion::discounted(0.95));
  const auto one = memory_one_reply(population, {test::cases<std::size_t>(300), 1});
  const auto four = memory_one_reply(population, {test::cases<std::size_t>(300), 4});
  EXPECT_EQ(one.strategy.after, four.strategy.after);
  EXPECT_EQ(one.payoff, four.payoff);
  EXPECT_EQ(one.certificate.points, four.certificate.points);
}

TEST(MemoryOneReply, RefusesWhatMakesNoSense) {
  const Automaton all_c = memory_one(1, {1, 1, 1, 1});
  test::expect_error<UsageError>([] { WeightedOpponents({}, {{}, long_run}); }, "nobody");
  test::expect_error<UsageError>([&] { WeightedOpponents({{all_c, 0}}, {{}, long_run}); }, "weight 0");
  test::expect_error<UsageError>([&] { WeightedOpponents({{all_c, 1}}, {{}, long_run, 2}); }, "noise 2");
  std::vector<Automaton::Node> long_chain(2000);
  for (std::uint32_t s = 0; s < 2000; ++s) long_chain[s].next.fill((s + 1) % 2000);
  const Automaton chain(long_chain, 0);
  test::expect_error<UsageError>([&] { WeightedOpponents({{chain, 1}}, {{}, long_run}); }, "2000 states");
}

TEST(MemoryOneReplyThreads, EndsAsItsProgressWishes) {
  const auto population = of({{0.5, 0.5, 0.5, 0.5}}, long_run);
  for (const unsigned threads : {1U, 4U})
    test::expect_ends([&](const Progress& progress) {
      EXPECT_EQ(memory_one_reply(population, {1, threads}, progress).certificate.faces, 162U);
    });
}

}  // namespace
}  // namespace folk
