// The optimiser: its schedule, its clipping, and what it leaves alone. Its steps are in the golden files.

#include <folk/sct/training/adamw.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>

namespace folk::sct {
namespace {

using Parts = std::vector<std::pair<std::size_t, std::size_t>>;

TEST(LearningRate, RisesToItsValueDuringTheWarmUp) {
  const AdamWSettings settings{.learning_rate = 0.5, .warmup_steps = 10};
  EXPECT_DOUBLE_EQ(settings.rate(0), 0.05);
  EXPECT_DOUBLE_EQ(settings.rate(4), 0.25);
  EXPECT_DOUBLE_EQ(settings.rate(9), 0.5);
  EXPECT_DOUBLE_EQ(settings.rate(1'000'000), 0.5);
  EXPECT_DOUBLE_EQ((AdamWSettings{.learning_rate = 0.5, .warmup_steps = 0}.rate(0)), 0.5);
}

TEST(LearningRate, FallsAlongAHalfCosine) {
  const AdamWSettings settings{.learning_rate = 2, .warmup_steps = 4, .decay_steps = 100};
  EXPECT_DOUBLE_EQ(settings.rate(0), 0.5);
  EXPECT_NEAR(settings.rate(50), 1, 1e-12);
  EXPECT_NEAR(settings.rate(25), 1 + std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(settings.rate(100), 0, 1e-12);
  EXPECT_NEAR(settings.rate(150), 0, 1e-12);
}

TEST(Norm, IsEuclidsAtAnyLength) {
  for (std::size_t size = 0; size < 50; ++size) {
    std::vector<float> gradient(size);
    double squares = 0;
    for (std::size_t i = 0; i < size; ++i) {
      gradient[i] = (i % 2 == 0 ? 1.0F : -1.0F) * static_cast<float>(i + 1);
      squares += static_cast<double>((i + 1) * (i + 1));
    }
    EXPECT_DOUBLE_EQ(norm<float>(gradient), std::sqrt(squares));
  }
}

/// Written out by hand from the paper, without clipping.
TEST(AdamW, TakesTheStepsOfThePaper) {
  const AdamWSettings settings{.learning_rate = 0.1, .weight_decay = 0.2, .clip = 1e9, .warmup_steps = 0};
  std::vector<double> parameters{1};
  AdamWState<double> state;
  double m = 0;
  double v = 0;
  double x = 1;
  for (int step = 1; step <= 5; ++step) {
    const std::vector<double> gradient{0.5 * step - 1.25};
    EXPECT_DOUBLE_EQ(adamw_step<double>(settings, Parts{{0, 1}}, gradient, state, parameters), std::abs(gradient[0]));
    m = 0.9 * m + 0.1 * gradient[0];
    v = 0.999 * v + 0.001 * gradient[0] * gradient[0];
    const double mean = m / (1 - std::pow(0.9, step));
    const double square = v / (1 - std::pow(0.999, step));
    x -= 0.1 * 0.2 * x + 0.1 * mean / (std::sqrt(square) + 1e-8);
    EXPECT_NEAR(parameters[0], x, 1e-12);
  }
  EXPECT_EQ(state.steps, 5U);
}

/// The moments, not the step, show the clipping: Adam's step hardly depends on the gradient's length.
TEST(AdamW, ClipsTheNormOfTheWholeGradient) {
  const AdamWSettings settings{.clip = 0.5};
  const auto first_moment = [&](std::vector<double> gradient) {
    std::vector<double> parameters(gradient.size());
    AdamWState<double> state;
    EXPECT_DOUBLE_EQ(adamw_step<double>(settings, Parts{{0, gradient.size()}}, gradient, state, parameters),
                     norm<double>(gradient));
    return state.first;
  };
  const auto small = first_moment({0.3, 0, 0.4});
  EXPECT_NEAR(small[0], 0.1 * 0.3, 1e-6);
  EXPECT_NEAR(small[2], 0.1 * 0.4, 1e-6);
  const auto large = first_moment({300, 0, -400});
  EXPECT_NEAR(large[0], 0.1 * 0.3, 1e-6);
  EXPECT_NEAR(large[2], -0.1 * 0.4, 1e-6);
}

TEST(AdamW, LeavesOtherPartsAloneButLetsZeroGradientsDecay) {
  const AdamWSettings settings{.learning_rate = 0.1, .weight_decay = 0.5, .warmup_steps = 0};
  const std::vector<float> gradient{0, 0, 1, 0, 0, 1};
  std::vector<float> parameters(6, 1.0F);
  AdamWState<float> state;
  adamw_step<float>(settings, Parts{{0, 1}, {2, 4}}, gradient, state, parameters);
  EXPECT_FLOAT_EQ(parameters[0], 0.95F);
  EXPECT_LT(parameters[2], 0.9F);
  EXPECT_FLOAT_EQ(parameters[3], 0.95F);
  for (const std::size_t i : {1U, 4U, 5U}) {
    EXPECT_EQ(parameters[i], 1.0F);
    EXPECT_EQ(state.first[i], 0.0F);
    EXPECT_EQ(state.second[i], 0.0F);
  }
}

}  // namespace
}  // namespace folk::sct
