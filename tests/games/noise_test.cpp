#include "games/expect_error.h"

#include <folk/games/match_rules.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

namespace folk {
namespace {

TEST(Noise, IsNoneUnlessSaid) {
  EXPECT_EQ(Noise().probability(), 0);
  EXPECT_EQ(MatchRules{}.noise.probability(), 0);
}

TEST(Noise, TakesBothEnds) {
  EXPECT_EQ(Noise(0).probability(), 0);
  EXPECT_EQ(Noise(1).probability(), 1);
}

TEST(Noise, RefusesWhatIsNoProbability) {
  test::expect_error<UsageError>([] { Noise(1.5); }, "noise 1.5: expected a number from 0 to 1");
  test::expect_error<UsageError>([] { Noise(-0.25); }, "noise -0.25: expected a number from 0 to 1");
  test::expect_error<UsageError>([] { Noise(std::nan("")); }, "noise nan");
  EXPECT_THROW(Noise(std::nextafter(1.0, 2.0)), UsageError);
  EXPECT_THROW(Noise(-std::numeric_limits<double>::denorm_min()), UsageError);
}

TEST(Noise, RulesKeepWhatTheyHadWhenAWrongOneIsGiven) {
  MatchRules rules;
  rules.noise = 0.1;
  EXPECT_THROW(rules.noise = 2, UsageError);
  EXPECT_EQ(rules.noise.probability(), 0.1);
}

RC_GTEST_PROP(NoiseProperty, IsTheNumberThatWasGiven, (std::uint32_t share)) {
  const double probability = share / static_cast<double>(std::numeric_limits<std::uint32_t>::max());
  const Noise noise = probability;
  RC_ASSERT(noise.probability() == probability);
  RC_ASSERT(1 - noise == 1 - probability);
}

}  // namespace
}  // namespace folk
