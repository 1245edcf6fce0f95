// Fixation: the closed form, fractions, simulations, and what rare mutations come to.

#include "analysis/evolution/some_scores.h"
#include "games/expect_error.h"

#include <folk/analysis/evolution/finite_population.h>
#include <folk/analysis/evolution/fixation.h>
#include <folk/analysis/evolution/simulated_fixation.h>
#include <folk/analysis/evolution/small_mutations.h>
#include <folk/analysis/play/state_reduction.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <map>

namespace folk {
namespace {

using test::scores_of;
using test::table_of;

const SelectionRules weak{Process::birth_death, Fitness::linear, Rational(1, 10), false};
const SelectionRules fermi{Process::pairwise_comparison, Fitness::linear, Rational(1, 4), false};

/// The formula as it stands in the papers, product by product.
long double by_definition(const TwoTypes<double>& u, std::uint64_t n, std::uint64_t i, const SelectionRules& rules) {
  long double all = 1;
  long double above = 1;
  long double product = 1;
  const auto w = static_cast<long double>(to_double(rules.intensity));
  const auto N = static_cast<long double>(n);
  for (std::uint64_t k = 1; k < n; ++k) {
    const auto j = static_cast<long double>(k);
    const long double a = (u.aa * (j - 1) + u.ab * (N - j)) / (N - 1);
    const long double b = (u.ba * j + u.bb * (N - j - 1)) / (N - 1);
    product *= rules.process == Process::pairwise_comparison ? std::exp(-w * (a - b))
               : rules.fitness == Fitness::exponential       ? std::exp(w * b) / std::exp(w * a)
                                                             : (1 - w + w * b) / (1 - w + w * a);
    all += product;
    if (k < i) above += product;
  }
  return i == 0 ? 0 : i == n ? 1 : above / all;
}

RC_GTEST_PROP(Fixation, IsTheClosedFormTo1e12, ()) {
  const auto payoff = [] { return static_cast<double>(*rc::gen::inRange(0, 60)) / 10; };
  const TwoTypes<double> u{payoff(), payoff(), payoff(), payoff()};
  const auto n = *rc::gen::inRange<std::uint64_t>(2, 60);
  const auto i = *rc::gen::inRange<std::uint64_t>(0, n + 1);
  SelectionRules rules{*rc::gen::element(Process::birth_death, Process::pairwise_comparison),
                       *rc::gen::element(Fitness::linear, Fitness::exponential),
                       *rc::gen::element(Rational(0), Rational(1, 100), Rational(1, 2), Rational(9, 10)), false};
  const auto expected = static_cast<double>(by_definition(u, n, i, rules));
  RC_ASSERT(std::abs(fixation_probability(u, n, i, rules) - expected) <= 1e-12 * expected);
}

TEST(Fixation, OfANeutralMutantIsOneInN) {
  for (const std::uint64_t n : {2, 7, 1000, 100000}) {
    EXPECT_NEAR(fixation_probability({3, 3, 3, 3}, n, 1, weak) * static_cast<double>(n), 1, 1e-12);
    EXPECT_NEAR(fixation_probability({3, 3, 3, 3}, n, 1, fermi) * static_cast<double>(n), 1, 1e-12);
  }
  EXPECT_EQ(exact_fixation_probability({3, 3, 3, 3}, 50, 7, weak), Rational(7, 50));
}

TEST(Fixation, OfConstantFitnessIsMorans) {
  // (1 - 1/r) / (1 - 1/r^N), r = 1.1 / 1 with w = 1.
  SelectionRules rules;
  const double r = 1.1;
  EXPECT_NEAR(fixation_probability({r, r, 1, 1}, 20, 1, rules), (1 - 1 / r) / (1 - std::pow(r, -20)), 1e-14);
  EXPECT_EQ(exact_fixation_probability({2, 2, 1, 1}, 3, 1, rules), Rational(4, 7));
}

TEST(Fixation, InFractionsAndInLogarithmsIsTheSame) {
  const auto scores = scores_of("all_c,all_d,tit_for_tat,pavlov,gradual", 50);
  const auto found = fixation_probabilities(*scores, 30, weak, true, 1);
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t j = 0; j < 5; ++j) {
      if (i == j) continue;
      const double exact = to_double(found.exact[i * 5 + j]);
      EXPECT_NEAR(found.probability(j, i), exact, 1e-12 * exact) << i << j;
    }
  EXPECT_NEAR(found.ratio(0, 2), 1, 1e-12);  // all_c among tit_for_tat is neutral
}

TEST(Fixation, WhereMutantsHaveNoFitness) {
  const SelectionRules whole;  // w = 1: fitness is the payoff
  // A single cooperator among defectors earns nothing.
  EXPECT_EQ(fixation_probability({3, 0, 5, 1}, 10, 1, whole), 0);
  EXPECT_EQ(exact_fixation_probability({3, 0, 5, 1}, 10, 1, whole), 0);
  const double two = to_double(exact_fixation_probability({3, 0, 5, 1}, 10, 2, whole));
  EXPECT_GT(two, 0);
  EXPECT_NEAR(fixation_probability({3, 0, 5, 1}, 10, 2, whole), two, 1e-12 * two);
  test::expect_error<UsageError>([&] { fixation_probability({0, 0, 0, 0}, 10, 1, whole); }, "smaller intensity");
  test::expect_error<UsageError>([&] { exact_fixation_probability({0, 0, 0, 0}, 10, 1, whole); }, "smaller intensity");
  test::expect_error<UsageError>([&] { exact_fixation_probability({3, 0, 5, 1}, 10, 1, fermi); }, "fractions");
  test::expect_error<UsageError>([&] { fixation_probability({3, 0, 5, 1}, 1, 1, weak); }, "expected 2");
  test::expect_error<UsageError>([&] { fixation_probability({3, 0, 5, 1}, 5, 6, weak); }, "at most all");
}

TEST(Fixation, TooRareForADoubleIsStillComparable) {
  const SelectionRules strong{Process::pairwise_comparison, Fitness::linear, 10, false};
  const auto log = log_fixation_probability({0, 0, 1, 1}, 1000, 1, strong);
  EXPECT_NEAR(static_cast<double>(log), -10 * 999.0, 0.01);
}

void simulations_agree(const Dynamics& model, const TwoTypes<double>& u, const SelectionRules& rules,
                       unsigned threads) {
  const Population start{4, 6};
  FixationCounts counts;
  simulate_fixation(counts, model, start, 4096, 1'000'000, 5, threads);
  EXPECT_EQ(counts.unsettled, 0U);
  const double p = fixation_probability(u, 10, 4, rules);
  EXPECT_NEAR(counts.share(0), p, 4 * std::sqrt(p * (1 - p) / 4096));
}

TEST(SimulatedFixation, AgreesWithTheFormulaWithinFourStandardErrors) {
  const auto scores = table_of({{3, 0}, {5, 1}});
  for (const auto& rules :
       {weak, fermi, SelectionRules{Process::birth_death, Fitness::exponential, Rational(1, 5), false},
        SelectionRules{Process::birth_death, Fitness::linear, Rational(1, 3), true}})
    simulations_agree(FinitePopulation(scores, {4, 6}, rules), {3, 0, 5, 1}, rules, 1);
}

TEST(SimulatedFixation, IsTheSameOnAnyNumberOfThreadsAndAfterAnyInterruption) {
  const auto scores = scores_of("all_c,all_d,tit_for_tat", 10);
  const Population start{5, 5, 5};
  const FinitePopulation model(scores, start, weak);
  FixationCounts whole;
  simulate_fixation(whole, model, start, 600, 100000, 9, 3);
  FixationCounts parts;
  int blocks = 0;
  const Progress once([](double) {});
  try {
    simulate_fixation(parts, model, start, 600, 100000, 9, 1, once, [&] {
      if (++blocks == 1) once.cancel();
    });
    FAIL();
  } catch (const Cancelled&) {
  }
  EXPECT_GT(parts.runs, 0U);
  EXPECT_LT(parts.runs, 600U);
  simulate_fixation(parts, model, start, 600, 100000, 9, 2);
  EXPECT_EQ(parts.taken_over, whole.taken_over);
  EXPECT_EQ(parts.runs, 600U);
  test::expect_error<UsageError>(
      [&] { simulate_fixation(parts, FinitePopulation(scores, start, weak, 0.1), start, 10, 10, 1, 1); }, "mutation");
}

TEST(SmallMutations, TheStationaryDistributionLeavesNoResidualInFractions) {
  const auto scores = scores_of("all_c,all_d,tit_for_tat,pavlov", 20);
  const auto fixation = fixation_probabilities(*scores, 20, weak, true, 1);
  const auto exact = exact_small_mutation_distribution(fixation);
  Rational sum = 0;
  for (const auto& share : exact) sum += share;
  EXPECT_EQ(sum, Rational(1));
  for (const auto& residual : stationarity_residual(fixation, exact)) EXPECT_TRUE(residual.is_zero());
  const auto rounded = small_mutation_distribution(fixation);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(rounded[i], to_double(exact[i]), 1e-14);
}

/// The whole chain of N individuals of three strategies with mutation, birth-death or pairwise comparison.
std::vector<double> of_full_chain(const ScoreMatrix& scores, int n, const SelectionRules& rules, double mutation) {
  std::map<std::array<int, 3>, int> number;
  std::vector<std::array<int, 3>> states;
  for (int a = n; a >= 0; --a)
    for (int b = n - a; b >= 0; --b) {
      number[{a, b, n - a - b}] = static_cast<int>(states.size());
      states.push_back({a, b, n - a - b});
    }
  const double w = to_double(rules.intensity);
  Transitions chain =
      Transitions::Zero(static_cast<Eigen::Index>(states.size()), static_cast<Eigen::Index>(states.size()));
  for (const auto& state : states) {
    std::array<double, 3> payoff{};
    double all = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) payoff[i] += state[j] * scores.payoff(i, j);
      payoff[i] = (payoff[i] - scores.payoff(i, i)) / (n - 1);
      all += state[i] * (1 - w + w * payoff[i]);
    }
    for (std::size_t dies = 0; dies < 3; ++dies)
      for (std::size_t born = 0; born < 3; ++born) {
        double probability = 0;  // that one of `dies` is replaced by one of `born`, before mutation
        if (rules.process == Process::birth_death) {
          probability = state[born] * (1 - w + w * payoff[born]) / all * state[dies] / n;
        } else if (born != dies) {
          probability = state[dies] / static_cast<double>(n) * state[born] / (n - 1) /
                        (1 + std::exp(-w * (payoff[born] - payoff[dies])));
        } else {
          double others = 0;
          for (std::size_t k = 0; k < 3; ++k)
            if (k != dies)
              others += state[dies] / static_cast<double>(n) * state[k] / (n - 1) /
                        (1 + std::exp(-w * (payoff[k] - payoff[dies])));
          probability = state[dies] / static_cast<double>(n) - others;
        }
        for (std::size_t becomes = 0; becomes < 3; ++becomes) {
          auto next = state;
          --next[dies];
          ++next[becomes];
          if (next[dies] < 0) continue;
          chain(number[state], number[next]) += probability * (becomes == born ? 1 - mutation : mutation / 2);
        }
      }
  }
  const auto distribution = stationary_distribution(chain);
  return {distribution[number[{n, 0, 0}]], distribution[number[{0, n, 0}]], distribution[number[{0, 0, n}]]};
}

TEST(SmallMutations, AreTheLimitOfTheFullChain) {
  const auto scores = scores_of("all_c,all_d,tit_for_tat", 10);
  for (const auto& rules : {weak, fermi}) {
    const auto limit = small_mutation_distribution(fixation_probabilities(*scores, 20, rules, false, 1));
    const auto full = of_full_chain(*scores, 20, rules, 1e-9);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(limit[i], full[i], 1e-6) << rules.text() << i;
  }
}

TEST(SmallMutations, SayWhereTheyDependOnTheStart) {
  // With the payoff as fitness a single stranger has none: nobody is ever replaced.
  const auto scores = table_of({{1, 0}, {0, 1}});
  const auto fixation = fixation_probabilities(*scores, 10, SelectionRules{}, false, 1);
  test::expect_error<UndecidedError>([&] { small_mutation_distribution(fixation); }, "depends on the start");
}

}  // namespace
}  // namespace folk
