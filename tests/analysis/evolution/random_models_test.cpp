// The random models: what a step may do, and how often it does.

#include "analysis/evolution/some_scores.h"
#include "games/expect_error.h"

#include <folk/analysis/evolution/evolution.h>
#include <folk/analysis/evolution/family_selection.h>
#include <folk/analysis/evolution/finite_population.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>

namespace folk {
namespace {

using test::scores_of;
using test::table_of;

double total_of(const Population& population) { return std::accumulate(population.begin(), population.end(), 0.0); }

constexpr int draws = 20000;

/// How often each population comes next.
std::map<Population, int> outcomes(const Dynamics& model, const Population& start) {
  std::map<Population, int> found;
  RandomStream random({.seed = 7});
  for (int i = 0; i < draws; ++i) {
    Population now = start;
    model.advance(now, random);
    ++found[now];
  }
  return found;
}

void expect_share(int count, double probability) {
  const double error = std::sqrt(probability * (1 - probability) / draws);
  EXPECT_NEAR(static_cast<double>(count) / draws, probability, 4 * error + 1e-12);
}

TEST(FamilySelection, EncountersAreDrawnByNumbers) {
  const auto scores = table_of({{2, 0}, {6, 1}});
  const Population start{6, 4};
  // With replacement: (a,a) 0.36, (b,b) 0.16, else 0.48. (a,a): a has 10 of 14, scaled to 7.14 and 2.86, of which one
  // is missing; (b,b): 6 of 12, 5 and 5; (a,b): 6 of 16, 3.75 and 6.25.
  auto found = outcomes(FamilySelection(scores, start, FamilyModel::encounter), start);
  ASSERT_EQ(found.size(), 5U);
  expect_share(found[{8, 2}], 0.18);
  expect_share(found[{7, 3}], 0.18);
  expect_share(found[{5, 5}], 0.16);
  expect_share(found[{4, 6}], 0.24);
  expect_share(found[{3, 7}], 0.24);
  // Without replacement it is always a and b.
  found = outcomes(FamilySelection(scores, start, FamilyModel::encounter, Income::communal), start);
  ASSERT_EQ(found.size(), 2U);
  expect_share(found[{4, 6}], 0.5);
}

TEST(FamilySelection, FermiDrawsByIncome) {
  const auto scores = table_of({{2, 0}, {6, 1}});
  const Population start{6, 4};
  // f = 6 (6*2 + 4*0) = 72 and 4 (6*6 + 4*1) = 160.
  const double a = 72.0 / 232;
  auto found = outcomes(FamilySelection(scores, start, FamilyModel::fermi), start);
  expect_share(found[{5, 5}], (1 - a) * (1 - a));
  expect_share(found[{4, 6}], a * (1 - a));
  expect_share(found[{8, 2}], a * a / 2);
}

TEST(FamilySelection, MoranBearsByIncomeAndBuriesByNumbers) {
  const auto scores = table_of({{2, 0}, {6, 1}});
  const Population start{6, 4};
  auto found = outcomes(FamilySelection(scores, start, FamilyModel::moran), start);
  const double a = 72.0 / 232;
  expect_share(found[{7, 3}], a * 0.4);
  expect_share(found[{5, 5}], (1 - a) * 0.6);
  // Without an income among one's own: f = 0 and 4 * 6 * 6.
  found = outcomes(FamilySelection(scores, start, FamilyModel::moran, Income::communal), start);
  expect_share(found[{5, 5}], 0.6);
}

TEST(FamilySelection, KeepsItsTotal) {
  const auto scores = scores_of("classics");
  const Population start(17, 20);
  for (const auto model : {FamilyModel::encounter, FamilyModel::moran, FamilyModel::fermi})
    for (const auto income : {Income::individual, Income::communal}) {
      Evolution evolution(std::make_shared<FamilySelection>(scores, start, model, income), start, 3);
      evolution.run(300, nullptr, [&] { ASSERT_EQ(total_of(evolution.state().population), 340); });
    }
}

TEST(FinitePopulation, StepsAsItsFormulasSay) {
  const auto scores = table_of({{3, 0}, {5, 1}});
  const Population start{6, 4};
  const double pi_a = (5 * 3.0 + 4 * 0) / 9;
  const double pi_b = (6 * 5.0 + 3 * 1) / 9;
  {
    SelectionRules rules;
    rules.intensity = Rational(1, 2);
    const double fa = 6 * (0.5 + 0.5 * pi_a);
    const double fb = 4 * (0.5 + 0.5 * pi_b);
    auto found = outcomes(FinitePopulation(scores, start, rules), start);
    expect_share(found[{7, 3}], fa / (fa + fb) * 0.4);
    expect_share(found[{5, 5}], fb / (fa + fb) * 0.6);
  }
  {
    SelectionRules rules{Process::birth_death, Fitness::exponential, Rational(2), true};
    const double fa = 6 * std::exp(2 * (6 * 3.0) / 10);
    const double fb = 4 * std::exp(2 * (6 * 5.0 + 4) / 10);
    auto found = outcomes(FinitePopulation(scores, start, rules), start);
    expect_share(found[{5, 5}], fb / (fa + fb) * 0.6);
  }
  {
    SelectionRules rules{Process::pairwise_comparison, Fitness::linear, Rational(1), false};
    const double meet = 2 * 0.6 * 4.0 / 9 / 2;  // the one who may change is of a, the model of b, or the other way
    auto found = outcomes(FinitePopulation(scores, start, rules), start);
    expect_share(found[{5, 5}], meet / (1 + std::exp(pi_a - pi_b)));
    expect_share(found[{7, 3}], meet / (1 + std::exp(pi_b - pi_a)));
  }
  {
    SelectionRules rules;
    rules.intensity = 0;
    auto found = outcomes(FinitePopulation(scores, {10, 0}, rules, 0.25), {10, 0});
    expect_share(found[{9, 1}], 0.25);
  }
}

TEST(FinitePopulation, SaysWhatItCannotTake) {
  const auto scores = table_of({{1, -3}, {2, 0}});
  SelectionRules rules;
  test::expect_error<UsageError>([&] { FinitePopulation(scores, {5, 5}, rules); }, "exponential");
  rules.intensity = 2;
  test::expect_error<UsageError>([&] { FinitePopulation(scores, {5, 5}, rules); }, "0 to 1");
  rules.fitness = Fitness::exponential;
  test::expect_error<UsageError>([&] { FinitePopulation(scores, {1, 0}, rules); }, "2 to 10^9");
  test::expect_error<UsageError>([&] { FinitePopulation(scores, {5, 5}, rules, 1.5); }, "mutation");
}

}  // namespace
}  // namespace folk
