// Ecological competition against the program of Mathieu & Delahaye, and integer selection against its definition.

#include "analysis/evolution/some_scores.h"
#include "csv.h"
#include "games/expect_error.h"

#include <folk/analysis/evolution/evolution.h>
#include <folk/analysis/evolution/integer_selection.h>
#include <folk/analysis/evolution/population_cooperation.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numeric>

namespace folk {
namespace {

using test::scores_of;
using test::table_of;

Evolution competition(const std::shared_ptr<const ScoreMatrix>& scores, double each = 100) {
  const Population start(scores->size(), each);
  return {std::make_shared<IntegerSelection>(scores, start), start};
}

TEST(EcologicalCompetition, OfTheClassicsIsThePublishedOneGenerationForGeneration) {
  const auto golden = test::read_csv("ecological17.csv");
  const auto cooperation = test::read_csv("ecological17_cooperation.csv");
  const auto scores = scores_of("classics", 1000);
  Evolution evolution = competition(scores);
  ASSERT_EQ(golden.size(), 27U);
  for (std::size_t row = 1; row < golden.size(); ++row) {
    const std::uint64_t generation = std::stoull(golden[row][0]);
    evolution.run(generation);
    ASSERT_EQ(evolution.state().generation, generation);
    for (std::size_t i = 0; i < scores->size(); ++i) {
      EXPECT_EQ(golden[0][i + 1], scores->names()[i]);
      EXPECT_EQ(evolution.state().population[i], std::stod(golden[row][i + 1])) << generation << scores->names()[i];
    }
    if (row >= cooperation.size()) continue;
    EXPECT_NEAR(100 * *population_cooperation(*scores, evolution.state().population, false),
                std::stod(cooperation[row][1]), 1e-10)
        << generation;
  }
  EXPECT_EQ(evolution.state().end, EvolutionEnd::fixed_point);
  evolution.run(1000);
  EXPECT_EQ(evolution.state().generation, 25U);
}

void agrees(const std::string& family, const std::string& file, std::uint64_t generations) {
  const auto golden = test::read_csv(file);
  const auto scores = scores_of(family, 1000);
  Evolution evolution = competition(scores);
  evolution.run(1000);
  EXPECT_EQ(evolution.state().generation, generations);
  EXPECT_EQ(evolution.state().end, EvolutionEnd::fixed_point);
  const auto ranking = evolution.ranking();
  ASSERT_EQ(golden.size(), ranking.size() + 1);
  for (std::size_t r = 0; r < ranking.size(); ++r) {
    const auto& row = golden[r + 1];
    EXPECT_EQ(std::stoull(row[0]), ranking[r].rank);
    EXPECT_EQ(row[1], scores->names()[ranking[r].entrant]);
    EXPECT_EQ(std::stod(row[2]), ranking[r].population) << row[1];
    EXPECT_EQ(row.size() > 3 ? std::stoull(row[3]) : 0, ranking[r].extinct_at.value_or(0)) << row[1];
  }
}

TEST(EcologicalCompetition, OfMemory11IsThePublishedOneRowForRow) {
  agrees("memory(1,1)", "memory_1_1_ecological.csv", 20);
}

TEST(EcologicalCompetition, OfMemory12IsThePublishedOneRowForRow) {
  agrees("memory(1,2)", "memory_1_2_ecological.csv", 175);
}

/// The rule in numbers without bounds, entrant by entrant.
Population by_definition(const ScoreMatrix& scores, const Population& now, const Integer& total, bool meets_itself,
                         bool communal, const Rational& rho) {
  std::vector<Integer> earned;
  Integer all = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    Integer each = 0;
    for (std::size_t j = 0; j < now.size(); ++j)
      if (!(communal && i == j))
        each += Integer(static_cast<std::int64_t>(now[j])) *
                Integer(scores.whole(scores.behaviour(i), scores.behaviour(j)));
    if (!meets_itself && !communal) each -= Integer(scores.whole(scores.behaviour(i), scores.behaviour(i)));
    earned.push_back(now[i] > 0 ? Integer(static_cast<std::int64_t>(now[i])) * each : Integer(0));
    all += earned.back();
  }
  if (all.is_zero()) return now;
  Population next;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const Rational stays = rho * Rational(static_cast<std::int64_t>(now[i]));
    const Rational grown = (Rational(1) - rho) * Rational(total) * Rational(earned[i]) / Rational(all);
    next.push_back(
        to_double(Integer(stays.numerator() / stays.denominator()) + Integer(grown.numerator() / grown.denominator())));
  }
  return next;
}

RC_GTEST_PROP(IntegerSelection, IsItsDefinitionAndNeverGrows, ()) {
  const auto n = *rc::gen::inRange<std::size_t>(1, 6);
  std::vector<std::vector<Rational>> rows(n, std::vector<Rational>(n));
  for (auto& row : rows)
    for (auto& score : row) score = Rational(*rc::gen::inRange(0, 1'000'000'000));
  const auto scores = table_of(rows);
  Population start;
  // Small numbers take 128 bits, large ones more.
  const double factor = *rc::gen::element(1.0, 1e4, 1e11);
  for (std::size_t i = 0; i < n; ++i) start.push_back(factor * *rc::gen::inRange(1, 1000));
  const IntegerSelectionSettings settings{*rc::gen::element(Income::individual, Income::communal),
                                          *rc::gen::arbitrary<bool>(),
                                          *rc::gen::element(Rational(0), Rational(1, 3), Rational(9, 10))};
  const double total = std::accumulate(start.begin(), start.end(), 0.0);
  const IntegerSelection model(scores, start, settings);
  Population now = start;
  RandomStream random;
  for (int step = 0; step < 5; ++step) {
    const auto expected = by_definition(*scores, now, Integer(static_cast<std::int64_t>(total)), settings.meets_itself,
                                        settings.income == Income::communal, settings.resilience);
    model.advance(now, random);
    RC_ASSERT(now == expected);
    RC_ASSERT(std::accumulate(now.begin(), now.end(), 0.0) <= total);
  }
}

TEST(IntegerSelection, AlwaysEnds) {
  // Rock, scissors, paper: there are finitely many populations, so that one comes back.
  const auto scores = table_of({{1, 2, 0}, {0, 1, 2}, {2, 0, 1}});
  const Population start{30, 10, 10};
  Evolution evolution(std::make_shared<IntegerSelection>(scores, start), start);
  evolution.run(100000);
  EXPECT_NE(evolution.state().end, EvolutionEnd::none);
}

TEST(IntegerSelection, SaysWhatItCannotTake) {
  const auto negative = table_of({{1, -1}, {2, 0}});
  test::expect_error<UsageError>([&] { IntegerSelection(negative, {10, 10}); }, "negative");
  const auto fine = table_of({{1, 1}, {2, 0}});
  test::expect_error<UsageError>([&] { IntegerSelection(fine, {1e15, 1}); }, "10^15");
  test::expect_error<UsageError>(
      [&] {
        IntegerSelection(fine, {10, 10}, {Income::individual, false, 1});
      },
      "resilience");
  test::expect_error<UsageError>(
      [&] {
        Evolution(std::make_shared<IntegerSelection>(fine, Population{1, 1}), {0, 0});
      },
      "somebody");
}

TEST(IntegerSelection, LeavesThingsAsTheyAreWhereNobodyEarns) {
  const auto nothing = table_of({{0, 0}, {0, 0}});
  const Population start{3, 4};
  Evolution evolution(std::make_shared<IntegerSelection>(nothing, start), start);
  evolution.run(10);
  EXPECT_EQ(evolution.state().population, start);
  EXPECT_EQ(evolution.state().end, EvolutionEnd::fixed_point);
}

}  // namespace
}  // namespace folk
