#include <folk/sct/training/selection.h>
#include <gtest/gtest.h>

namespace folk::sct {
namespace {

TEST(Selection, TheHighestTotalIsTheBestTarget) {
  const Evaluation evaluation{10, 0, 0, {{260, 4700, 0.9}, {280, 4800, 0.8}, {300, 4750, 1.0}}};
  EXPECT_EQ(best_target(evaluation).target, 280);
}

TEST(Selection, OfEqualTargetsTheLowestInAnyOrder) {
  EXPECT_EQ(best_target({10, 0, 0, {{280, 4800, {}}, {260, 4800, {}}, {300, 4800, {}}}}).target, 260);
}

TEST(Selection, ALaterPolicyMustBeAsGood) {
  const Evaluation kept{10, 0, 0, {{260, 4700, {}}, {280, 4800, {}}}};
  EXPECT_TRUE(takes_over({20, 0, 0, {{260, 4800, {}}, {280, 4700, {}}}}, kept));
  EXPECT_FALSE(takes_over({20, 0, 0, {{260, 4799, {}}}}, kept));
  EXPECT_TRUE(takes_over({20, 0, 0, {{300, 4800.25, {}}}}, kept));
}

/// An evaluation with one score, of these totals against the roster and the held-out one.
Evaluation held_out(double total, double held_out) { return {10, 0, 0, {{260, total, {}, {{held_out, {}}}}}}; }

TEST(Selection, WhatIsHeldOutDecides) {
  EXPECT_EQ(best_target({10, 0, 0, {{260, 4700, {}, {{900, {}}}}, {280, 4800, {}, {{800, {}}}}}}).target, 260);
  EXPECT_TRUE(takes_over(held_out(4700, 900), held_out(4800, 900)));
  EXPECT_FALSE(takes_over(held_out(4900, 899), held_out(4800, 900)));
}

TEST(Selection, PatienceEndsWithTheEvaluationsThatAreNoBetter) {
  const auto end = [](const std::vector<double>& totals, std::uint64_t patience) {
    std::vector<Evaluation> history;
    for (const double total : totals) history.push_back({10, 0, 0, {{260, total, {}}}});
    return end_of_patience(history, patience);
  };
  EXPECT_EQ(end({}, 1), std::nullopt);
  EXPECT_EQ(end({5}, 1), std::nullopt);
  EXPECT_EQ(end({5, 4, 3, 2, 1}, 0), std::nullopt);
  EXPECT_EQ(end({5, 4}, 1), 1U);
  EXPECT_EQ(end({5, 5}, 1), 1U);  // as good is no better
  EXPECT_EQ(end({5, 4, 6, 5, 6, 7}, 2), 4U);
  EXPECT_EQ(end({5, 4, 6, 5, 7, 6}, 2), std::nullopt);
  EXPECT_EQ(end({5, 4, 3, 9}, 2), 2U);  // what comes after changes nothing
  EXPECT_EQ(end_of_patience({held_out(1, 5), held_out(2, 4), held_out(3, 4)}, 2), 2U);
}

}  // namespace
}  // namespace folk::sct
