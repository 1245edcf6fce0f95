// Exact Markov payoffs against simulation, against the cycle of pure pairs, and against the theory of Press & Dyson.

#include "analysis/play/naive.h"

#include <folk/analysis/play/deterministic_play.h>
#include <folk/analysis/play/markov_play.h>
#include <folk/analysis/play/sampled_play.h>
#include <folk/games/error.h>
#include <folk/strategies/memory_one.h>
#include <folk/strategies/registry.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace folk {
namespace {

struct Scores {
  double first, second;
};

Scores scores(const OutcomeWeights& w) { return {3 * w[0] + 5 * w[2] + w[3], 3 * w[0] + 5 * w[1] + w[3]}; }

Strategy named(std::string name, Automaton automaton) {
  return {std::move(name), std::make_shared<Automaton>(std::move(automaton)), nullptr};
}

Automaton random_memory_one(RandomStream& random) {
  // A third of the probabilities are pure, so that chains with several recurrent classes occur; the others stay away
  // from 0 and 1, or absorption would take longer than the matches that are simulated.
  const auto p = [&] {
    const double u = random.uniform();
    return u < 1.0 / 6 ? 0.0 : u < 1.0 / 3 ? 1.0 : 0.05 + 0.9 * random.uniform();
  };
  const double first = p();
  return memory_one(first, {p(), p(), p(), p()});
}

OutcomeWeights divided(OutcomeWeights weights, double by) {
  for (double& weight : weights) weight /= by;
  return weights;
}

/// What simulation estimates without bias: a simulated mean is one of long_run_rounds rounds.
OutcomeWeights simulated_target(const Automaton& a, const Automaton& b, double noise, const Criterion& criterion) {
  if (criterion.kind() != Criterion::Kind::mean) return play_markov(a, b, noise, criterion)->weights;
  const auto sum = play_markov(a, b, noise, Criterion::finite(long_run_rounds))->weights;
  return divided(sum, static_cast<double>(long_run_rounds));
}

/// 200 random pairs under this criterion and noise: exact and simulated payoffs within 4 standard errors.
void agrees_with_simulation(const Criterion& criterion, double noise, std::uint64_t repetitions) {
  RandomStream random({42, 0, 0, 0});
  for (std::uint64_t i = 0; i < 200; ++i) {
    const Automaton a = random_memory_one(random);
    const Automaton b = random_memory_one(random);
    const Scores expected = scores(simulated_target(a, b, noise, criterion));
    const Strategy first = named("a", a);
    const Strategy second = named("b", b);
    const auto sampled =
        play_sampled({Contest{&first, &second, i}}, {{Payoffs{}, criterion, noise}, repetitions, 2026}).front();
    const Scores found = scores(sampled.weights);
    const double rounding = 1e-9 * criterion.total_weight();  // a pair that plays without chance has no standard error
    EXPECT_NEAR(expected.first, found.first, 4 * sampled.first_error + rounding) << i;
    EXPECT_NEAR(expected.second, found.second, 4 * sampled.second_error + rounding) << i;
  }
}

TEST(MarkovPlay, TheLongRunMeanIsTheLimitOfFiniteOnes) {
  RandomStream random({42, 0, 0, 0});
  for (const double noise : {0.0, 0.03})
    for (int i = 0; i < 200; ++i) {
      const Automaton a = random_memory_one(random);
      const Automaton b = random_memory_one(random);
      const auto limit = play_markov(a, b, noise, Criterion::mean())->weights;
      const auto long_sum = play_markov(a, b, noise, Criterion::finite(1'000'000'000'000))->weights;
      for (std::size_t o = 0; o < 4; ++o) EXPECT_NEAR(limit[o], long_sum[o] / 1e12, 1e-7) << i;
    }
}

TEST(MarkovPlay, AgreesWithSimulationOverFiniteRounds) { agrees_with_simulation(Criterion::finite(50), 0, 2000); }
TEST(MarkovPlay, AgreesWithSimulationUnderNoise) { agrees_with_simulation(Criterion::finite(50), 0.05, 2000); }
TEST(MarkovPlay, AgreesWithSimulationWhenDiscounted) { agrees_with_simulation(Criterion::discounted(0.9), 0.02, 1000); }
TEST(MarkovPlay, AgreesWithSimulationOfRandomLength) { agrees_with_simulation(Criterion::ending(0.05), 0.02, 2000); }
TEST(MarkovPlay, AgreesWithSimulationInTheLongRun) { agrees_with_simulation(Criterion::mean(), 0.03, 30); }
TEST(MarkovPlay, AgreesWithSimulationInTheLongRunWithoutNoise) { agrees_with_simulation(Criterion::mean(), 0, 60); }

RC_GTEST_PROP(MarkovPlay, IsThePlayOfPurePairs, ()) {
  RandomStream random({*rc::gen::arbitrary<std::uint64_t>(), 2, 0, 0});
  const Automaton a = test::random_automaton(random, 8, true);
  const Automaton b = test::random_automaton(random, 8, true);
  for (const auto& criterion : {Criterion::finite(100), Criterion::finite(1'000'000'000'000), Criterion::mean(),
                                Criterion::discounted(0.95), Criterion::ending(0.01)}) {
    const auto solved = play_markov(a, b, 0, criterion);
    RC_ASSERT(solved.has_value());
    const auto played = play_deterministic(a, b, criterion);
    for (std::size_t o = 0; o < 4; ++o)
      RC_ASSERT(std::abs(solved->weights[o] - played.weights[o]) <= 1e-9 * criterion.total_weight());
  }
}

RC_GTEST_PROP(MarkovPlay, DoublingIsSteppingAndTheMeanIsTheirLimit, ()) {
  RandomStream random({*rc::gen::arbitrary<std::uint64_t>(), 3, 0, 0});
  const Automaton a = test::random_automaton(random, 3, false);
  const Automaton b = test::random_automaton(random, 3, false);
  const auto stepped = play_markov(a, b, 0.01, Criterion::finite(40));
  const auto doubled = play_markov(a, b, 0.01, Criterion::finite(1'000'000'000));
  const auto limit = play_markov(a, b, 0.01, Criterion::mean());
  double weight = 0;
  for (std::size_t o = 0; o < 4; ++o) {
    weight += stepped->weights[o];
    RC_ASSERT(std::abs(doubled->weights[o] / 1e9 - limit->weights[o]) < 1e-5);
  }
  RC_ASSERT(std::abs(weight - 40) < 1e-10);
}

TEST(MarkovPlay, SeesTheTwoAbsorbingEndsOfAMixedStart) {
  // With probability 0.3 grim meets C for ever, else D for ever.
  const Automaton fickle({{0.3, {1, 1, 2, 2}}, {1, {1, 1, 1, 1}}, {0, {2, 2, 2, 2}}}, 0);
  const auto grim = Registry::standard().make("spiteful");
  const auto table = *tabulate(*grim.machine, Sense::own_moves_its_own);
  const auto limit = play_markov(fickle, table, 0, Criterion::mean());
  EXPECT_NEAR(limit->weights[0], 0.3, 1e-12);
  EXPECT_NEAR(limit->weights[3], 0.7, 1e-12);
}

TEST(MarkovPlay, SolvesLargeChainsAsWellRoundByRoundAsAtOnce) {
  RandomStream random({6, 0, 0, 0});
  const Automaton a = test::random_automaton(random, 40, false);
  const Automaton b = test::random_automaton(random, 40, false);
  for (const auto& criterion : {Criterion::discounted(0.95), Criterion::ending(0.02)}) {
    const auto stepped =
        play_markov(a, b, 0.01, criterion, {.joint_states = 100'000, .solved_states = 0, .work = 100'000'000});
    const auto solved =
        play_markov(a, b, 0.01, criterion, {.joint_states = 100'000, .solved_states = 100'000, .work = 0});
    for (std::size_t o = 0; o < 4; ++o)
      EXPECT_NEAR(stepped->weights[o], solved->weights[o], 1e-12 * criterion.total_weight());
  }
}

TEST(MarkovPlay, RefusesWhatCostsTooMuch) {
  RandomStream random({5, 0, 0, 0});
  const Automaton a = test::random_automaton(random, 50, false);
  EXPECT_FALSE(
      play_markov(a, a, 0.1, Criterion::finite(10), {.joint_states = 3, .solved_states = 1000, .work = 1'000'000}));
  EXPECT_FALSE(play_markov(a, a, 0.1, Criterion::finite(1'000'000'000),
                           {.joint_states = 5000, .solved_states = 1000, .work = 1000}));
}

TEST(ZeroDeterminant, EnforcesItsLinearRelation) {
  RandomStream random({11, 0, 0, 0});
  const Payoffs payoffs;
  for (int i = 0; i < 200; ++i) {
    const double chi = 1 + 9 * random.uniform();
    const Automaton extort = memory_one(1, zero_determinant(payoffs, Baseline::punishment, chi));
    const Automaton generous = memory_one(1, zero_determinant(payoffs, Baseline::reward, chi));
    // Opponents that never play purely: one recurrent class, as the theorem supposes.
    const auto p = [&] { return 0.02 + 0.96 * random.uniform(); };
    const Automaton opponent = memory_one(p(), {p(), p(), p(), p()});
    const Scores taken = scores(play_markov(extort, opponent, 0, Criterion::mean())->weights);
    EXPECT_NEAR(taken.first - 1, chi * (taken.second - 1), 1e-9) << chi;
    const Scores given = scores(play_markov(generous, opponent, 0, Criterion::mean())->weights);
    EXPECT_NEAR(given.first - 3, chi * (given.second - 3), 1e-9) << chi;
  }
}

TEST(Equalizer, SetsTheOpponentsPayoff) {
  RandomStream random({12, 0, 0, 0});
  for (int i = 0; i < 100; ++i) {
    const double v = 1.05 + 1.9 * random.uniform();
    const Automaton equal = memory_one(1, equalizer(Payoffs{}, v));
    const Automaton opponent = random_memory_one(random);
    const auto limit = play_markov(equal, opponent, 0, Criterion::mean());
    EXPECT_NEAR(scores(limit->weights).second, v, 1e-9) << v;
  }
}

// 1.5 gave weights of 350,000, and -0.25 counted as none.
TEST(MarkovPlay, TakesNoNoiseThatIsNoProbability) {
  const Automaton machine = memory_one(1, {1, 0, 1, 0});
  for (const double noise : {1.5, -0.25, std::nan("")})
    EXPECT_THROW(play_markov(machine, machine, noise, Criterion::mean()), UsageError) << noise;
}

}  // namespace
}  // namespace folk
