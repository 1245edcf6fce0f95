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

}  // namespace
}  // namespace folk::sct
