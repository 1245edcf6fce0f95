// The replicator equation against its definition.

#include "analysis/evolution/some_scores.h"
#include "games/expect_error.h"

#include <folk/analysis/evolution/evolution.h>
#include <folk/analysis/evolution/replicator.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <numeric>

namespace folk {
namespace {

using test::scores_of;
using test::table_of;

RC_GTEST_PROP(Replicator, StaysInTheSimplexAndIsItsDefinition, ()) {
  const auto n = *rc::gen::inRange<std::size_t>(2, 6);
  std::vector<std::vector<Rational>> rows(n, std::vector<Rational>(n));
  for (auto& row : rows)
    for (auto& score : row) score = Rational(*rc::gen::inRange(1, 1000), 100);
  const auto scores = table_of(rows);
  ReplicatorSettings settings;
  settings.mutation = *rc::gen::element(0.0, 0.01, 0.3);
  settings.resilience = *rc::gen::element(0.0, 0.5);
  settings.income = *rc::gen::element(Income::individual, Income::communal);
  const Replicator model(scores, settings);
  Population now;
  for (std::size_t i = 0; i < n; ++i) now.push_back(*rc::gen::inRange(1, 100));
  const double sum = std::accumulate(now.begin(), now.end(), 0.0);
  for (double& share : now) share /= sum;
  const Population before = now;
  RandomStream random;
  model.advance(now, random);
  std::vector<double> earned(n, 0);
  double phi = 0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j)
      if (i != j || settings.income == Income::individual) earned[i] += before[i] * before[j] * scores->score(i, j);
    phi += earned[i];
  }
  for (std::size_t i = 0; i < n; ++i) {
    double born = 0;
    for (std::size_t j = 0; j < n; ++j)
      born += earned[j] / phi * (i == j ? 1 - settings.mutation : settings.mutation / static_cast<double>(n - 1));
    RC_ASSERT(std::abs(now[i] - (settings.resilience * before[i] + (1 - settings.resilience) * born)) < 1e-12);
  }
  for (int step = 0; step < 50; ++step) model.advance(now, random);
  RC_ASSERT(std::abs(std::accumulate(now.begin(), now.end(), 0.0) - 1) < 1e-12);
  for (const double share : now) RC_ASSERT(share >= 0);
}

TEST(Replicator, RestsAtTheMixedEquilibriumOfHawksAndDoves) {
  // V = 2, C = 6, all payoffs raised by 2: a third of hawks.
  const auto scores = table_of({{0, 4}, {2, 3}});
  ReplicatorSettings settings;
  settings.tolerance = 1e-13;
  Evolution evolution(std::make_shared<Replicator>(scores, settings), {1, 9});
  evolution.run(100000);
  EXPECT_EQ(evolution.state().end, EvolutionEnd::fixed_point);
  EXPECT_NEAR(evolution.state().population[0], 1.0 / 3, 1e-9);
}

TEST(Replicator, WithMutationNobodyIsLostForGood) {
  const auto scores = scores_of("all_c,all_d,tit_for_tat");
  ReplicatorSettings settings;
  settings.mutation = 0.001;
  Evolution evolution(std::make_shared<Replicator>(scores, settings), {0, 1, 0});
  evolution.run(1);
  EXPECT_NEAR(evolution.state().population[0], 0.0005, 1e-12);
  test::expect_error<UsageError>([&] { Replicator(table_of({{1}}), settings); }, "two strategies");
}

}  // namespace
}  // namespace folk
