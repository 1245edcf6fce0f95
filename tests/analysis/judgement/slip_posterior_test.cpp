#include <folk/analysis/judgement/slip_posterior.h>
#include <folk/games/error.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace folk {
namespace {

TEST(SlipPosterior, IsBayesRule) {
  // Two candidates, one twice as likely before; two slip rates.
  const auto posterior = slip_posterior({2, 1}, {{std::log(0.1), std::log(0.2)}, {-INFINITY, std::log(0.5)}});
  const double all = 2 * 0.1 + 2 * 0.2 + 0.5;
  EXPECT_NEAR(posterior.candidates[0], 2 * 0.3 / all, 1e-15);
  EXPECT_NEAR(posterior.candidates[1], 0.5 / all, 1e-15);
  EXPECT_NEAR(posterior.slips[0], 0.2 / all, 1e-15);
  EXPECT_NEAR(posterior.log_evidence, std::log(all / 6), 1e-14);
  EXPECT_EQ(posterior.likeliest_slip[0], 1U);
  EXPECT_EQ(posterior.likeliest(), 0U);
}

TEST(SlipPosterior, KeepsTinyLikelihoodsApart) {
  const auto posterior = slip_posterior({1, 1, 1}, {{-100000}, {-100001}, {-200000}});
  EXPECT_NEAR(posterior.candidates[0], 1 / (1 + std::exp(-1)), 1e-12);
  EXPECT_NEAR(std::accumulate(posterior.candidates.begin(), posterior.candidates.end(), 0.0), 1, 1e-15);
  EXPECT_TRUE(posterior.possible());
}

TEST(SlipPosterior, SaysWhenNothingIsPossible) {
  const auto posterior = slip_posterior({1, 1}, {{-INFINITY}, {-INFINITY}});
  EXPECT_FALSE(posterior.possible());
  EXPECT_EQ(posterior.candidates[0] + posterior.candidates[1], 0);
  EXPECT_THROW(slip_posterior({}, {}), UsageError);
}

TEST(SlipPosterior, TakesRatesBelowOneHalfEachOnce) {
  check_slips(usual_slips());
  EXPECT_THROW(check_slips({}), UsageError);
  EXPECT_THROW(check_slips({0.5}), UsageError);
  EXPECT_THROW(check_slips({-0.1}), UsageError);
  EXPECT_THROW(check_slips({NAN}), UsageError);
  EXPECT_THROW(check_slips({0.1, 0.2, 0.1}), UsageError);
}

}  // namespace
}  // namespace folk
