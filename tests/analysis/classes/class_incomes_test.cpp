#include <folk/analysis/classes/class_incomes.h>
#include <folk/games/error.h>

#include <analysis/classes/naive_class.h>
#include <gtest/gtest.h>

#include <random>

namespace folk {
namespace {

/// Some members with random numbers, against sums over pairs.
void expect_income_by_pairs(const MemoryClass& members, const char* criterion, double share, unsigned threads) {
  const auto tables = test::listed(members);
  std::mt19937 random(7);
  std::vector<std::uint32_t> living;
  std::vector<std::int64_t> numbers;
  double individuals = 0;
  for (std::uint32_t i = 0; i < tables.size(); ++i)
    if (std::uniform_real_distribution<>()(random) < share) {
      living.push_back(i);
      numbers.push_back(1 + static_cast<std::int64_t>(random() % 1000));
      individuals += static_cast<double>(numbers.back());
    }
  const MatchRules rules{{}, Criterion::parse(criterion)};
  const ClassIncomes incomes(members, rules.payoffs, rules.criterion, individuals, threads);
  const auto found = incomes(living, numbers);
  const auto copies = incomes.own_copies(living);
  CycleFinder finder;
  for (std::size_t i = 0; i < living.size(); i += 1 + living.size() / 50) {
    double income = 0;
    for (std::size_t j = 0; j < living.size(); ++j)
      income +=
          static_cast<double>(numbers[j]) * test::naive_match(finder, tables[living[i]], tables[living[j]], rules).own;
    EXPECT_NEAR(static_cast<double>(found[i]) / incomes.scale().score_unit, income, 1e-11 * income) << criterion;
    EXPECT_NEAR(static_cast<double>(copies[i]) / incomes.scale().score_unit,
                test::naive_match(finder, tables[living[i]], tables[living[i]], rules).own, 1e-9);
    if (rules.criterion.is_finite()) {
      EXPECT_EQ(static_cast<double>(found[i]), income);
    }
  }
}

TEST(ClassIncomes, AreSumsOverPairs) {
  for (const auto& [own, theirs] : {std::pair{1U, 1U}, {1U, 2U}, {2U, 1U}, {3U, 0U}})
    for (const char* criterion : {"finite:1000", "finite:1", "mean", "discounted:0.9"})
      for (const double share : {1.0, 0.3, 0.02}) expect_income_by_pairs({own, theirs}, criterion, share, 1);
}

TEST(ClassIncomes, AreSumsOverPairsInTheLargestClass) { expect_income_by_pairs({2, 2}, "finite:1000", 0.01, 2); }

TEST(ClassIncomes, ThreadsDoNotChangeThem) { expect_income_by_pairs({1, 2}, "finite:100", 0.5, 4); }

TEST(ClassIncomes, AreRefusedWhereTheyGrowTooLarge) {
  EXPECT_THROW(ClassIncomes({2, 2}, {}, Criterion::finite(1'000'000'000'000), 1e9), UsageError);
  EXPECT_THROW(ClassIncomes({2, 3}, {}, Criterion::finite(100), 1e9), UsageError);
}

}  // namespace
}  // namespace folk
