#include "analysis/play/naive.h"

#include <folk/analysis/thresholds/plan_payoffs.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace folk {
namespace {

/// The discounted sum, by rounds.
double sum(const PlanPayoffs& plan, std::uint32_t state, double d) {
  double total = 0;
  double weight = 1;
  for (; weight > 1e-18; weight *= d, state = plan.next(state)) total += weight * to_double(plan.payoff(state));
  return total;
}

PlanPayoffs random_plan(RandomStream& random) {
  const auto size = static_cast<std::uint32_t>(1 + random() % 12);
  std::vector<std::uint32_t> next;
  std::vector<Integer> payoff;
  for (std::uint32_t i = 0; i < size; ++i) {
    next.push_back(static_cast<std::uint32_t>(random() % size));
    payoff.push_back(static_cast<int>(random() % 3));
  }
  return {next, payoff};
}

double value(const Polynomial& p, double d) {
  double total = 0;
  for (std::size_t i = p.coefficients().size(); i-- > 0;) total = total * d + to_double(p.coefficients()[i]);
  return total;
}

TEST(PlanPayoffs, PeriodsAreThoseOfThePayoffs) {
  const PlanPayoffs plan({1, 2, 3, 4, 1}, {9, 1, 2, 1, 2});
  EXPECT_EQ(plan.period(0), 2U);
  EXPECT_EQ(plan.rounds_before(0), 1U);
  EXPECT_EQ(plan.rounds_before(3), 0U);
}

TEST(PlanPayoffs, TooManyTermsAreNothing) {
  const PlanPayoffs plan({1, 2, 0}, {0, 1, 2});
  EXPECT_FALSE(advantage({plan, 0, 0}, {plan, 1, 1}, 3));
  EXPECT_TRUE(advantage({plan, 0, 0}, {plan, 1, 1}, 4));
}

RC_GTEST_PROP(PlanPayoffs, AdvantagesHaveTheSignOfTheDiscountedDifference, ()) {
  RandomStream random({*rc::gen::arbitrary<std::uint64_t>(), 2, 0, 0});
  const PlanPayoffs one = random_plan(random);
  const PlanPayoffs two = random_plan(random);
  const double d = 0.1 + 0.8 * random.uniform();
  RC_ASSERT(std::abs(one.values(d)[0] - sum(one, 0, d)) < 1e-9);
  const Integer now = static_cast<int>(random() % 3);
  for (const PlanPayoffs* other : {&one, &two}) {
    const std::uint32_t then = other == &one ? one.next(0) : 0;
    const auto p = advantage({one, one.payoff(0), one.next(0)}, {*other, now, then}, 1000);
    RC_ASSERT(p.has_value());
    const double difference = sum(one, 0, d) - to_double(now) - d * sum(*other, then, d);
    // The polynomial is the difference times a positive number of at most 1 / (1 - d).
    const double found = value(*p, d);
    if (std::abs(difference) < 1e-9)
      RC_ASSERT(std::abs(found) < 1e-7);
    else
      RC_ASSERT((found > 0) == (difference > 0));
  }
}

}  // namespace
}  // namespace folk
