// The loss of an autoencoder of actions against its plain form, and its gradient against finite differences.

#include <folk/games/random.h>
#include <folk/mpe/offline/action_vae.h>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mpe/offline/plain_network.h"

namespace folk::mpe {
namespace {

using test::joined;
using test::plain_network;
using test::row_of;

struct VaeSpecimen {
  ActionVaeShape shape;
  std::vector<double> parameters;
  Matrix<double> input;  // [observation | action]
  Matrix<double> normals;

  VaeSpecimen(std::uint64_t seed, std::size_t observed, std::size_t hidden, Index rows)
      : shape(observed, hidden),
        parameters(shape.parameters()),
        input(rows, index(observed + 2)),
        normals(rows, index(ActionVaeShape::latent)) {
    RandomStream random({.seed = seed});
    for (double& number : parameters) number = random.uniform() - 0.5;
    for (Index i = 0; i < input.size(); ++i) input.data()[i] = 2 * random.uniform() - 1;
    for (Index i = 0; i < normals.size(); ++i) normals.data()[i] = random.normal();
  }

  static VaeSpecimen any() {
    return {*rc::gen::arbitrary<std::uint64_t>(), *rc::gen::inRange<std::size_t>(1, 6),
            *rc::gen::inRange<std::size_t>(1, 8), *rc::gen::inRange<Index>(1, 7)};
  }

  double loss(std::vector<double>& gradient, Index first, Index rows, std::size_t examples) const {
    ActionVaeTape<double> tape;
    tape.encoder.prepare(shape.encoder(), static_cast<std::size_t>(rows));
    tape.encoder.input() = input.middleRows(first, rows);
    const Matrix<double> some = normals.middleRows(first, rows);
    return action_vae_loss(shape, parameters.data(), some, examples, tape, gradient.data());
  }

  double loss(std::vector<double>& gradient) const {
    return loss(gradient, 0, input.rows(), static_cast<std::size_t>(input.rows()));
  }

  double plain_loss() const {
    const auto rows = static_cast<std::size_t>(input.rows());
    double errors = 0;
    double divergences = 0;
    for (std::size_t r = 0; r < rows; ++r) {
      auto observation = row_of(input, r);
      const std::vector<double> action(observation.end() - 2, observation.end());
      const auto code = plain_network(shape.encoder(), parameters.data(), observation);
      observation.resize(shape.observed());
      std::vector<double> latent;
      for (std::size_t k = 0; k < 4; ++k) {
        const double s = std::exp(std::clamp(code[4 + k], -4.0, 15.0));
        latent.push_back(code[k] + s * normals(index(r), index(k)));
        divergences += -0.5 * (1 + std::log(s * s) - code[k] * code[k] - s * s);
      }
      const auto decoded =
          plain_network(shape.decoder(), parameters.data() + shape.decoder_begin(), joined(observation, latent));
      for (std::size_t c = 0; c < 2; ++c) errors += std::pow(std::tanh(decoded[c]) - action[c], 2);
    }
    const double count = static_cast<double>(rows);
    return errors / (2 * count) + 0.5 * divergences / (4 * count);
  }
};

RC_GTEST_PROP(ActionVae, LossIsThatOfItsDefinition, ()) {
  const auto specimen = VaeSpecimen::any();
  std::vector<double> gradient(specimen.parameters.size());
  const double plain = specimen.plain_loss();
  RC_ASSERT(std::abs(specimen.loss(gradient) - plain) <= 1e-10 * std::max(1.0, plain));
}

TEST(ActionVae, GradientIsThatOfFiniteDifferences) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    VaeSpecimen specimen(seed, 3, 5, 4);
    std::vector<double> gradient(specimen.parameters.size(), 7.0);  // it is added to what is there
    specimen.loss(gradient);
    for (std::size_t i = 0; i < gradient.size(); ++i)
      EXPECT_NEAR(gradient[i] - 7, test::difference(specimen.parameters[i], [&] { return specimen.plain_loss(); }),
                  1e-7)
          << i;
  }
}

// The biases of the encoder's last layer set a log deviation beyond what it is cut to.
TEST(ActionVae, ALogDeviationThatIsCutHasNoGradient) {
  for (const double bias : {-9.0, 19.0}) {
    VaeSpecimen specimen(4, 3, 5, 4);
    const MlpShape& encoder = specimen.shape.encoder();
    const std::size_t at = encoder.bias(2) + 4 + 1;
    specimen.parameters[at] = bias;
    std::vector<double> gradient(specimen.parameters.size());
    const double plain = specimen.plain_loss();
    EXPECT_NEAR(specimen.loss(gradient), plain, 1e-10 * plain);
    EXPECT_EQ(gradient[at], 0);
    EXPECT_NE(gradient[at - 1], 0);
    for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(gradient[encoder.weight(2) + (4 + 1) * 5 + k], 0);
  }
}

RC_GTEST_PROP(ActionVae, PiecesOfABatchAddUp, ()) {
  const auto specimen = VaeSpecimen::any();
  const auto rows = specimen.input.rows();
  const auto examples = static_cast<std::size_t>(rows);
  const Index cut = *rc::gen::inRange<Index>(0, rows);
  std::vector<double> whole(specimen.parameters.size());
  std::vector<double> sum(whole.size());
  const double loss = specimen.loss(whole);
  double parts = specimen.loss(sum, cut, rows - cut, examples);
  if (cut > 0) parts += specimen.loss(sum, 0, cut, examples);
  RC_ASSERT(std::abs(parts - loss) <= 1e-12 * std::max(1.0, loss));
  for (std::size_t i = 0; i < sum.size(); ++i)
    RC_ASSERT(std::abs(sum[i] - whole[i]) <= 1e-11 * std::max(1.0, std::abs(whole[i])));
}

TEST(ActionVaeShape, IsAnEncoderAndADecoder) {
  const ActionVaeShape shape(16, 750);
  EXPECT_EQ(shape.encoder(), MlpShape({18, 750, 750, 8}));
  EXPECT_EQ(shape.decoder(), MlpShape({20, 750, 750, 2}));
  EXPECT_EQ(shape.observed(), 16U);
  EXPECT_EQ(shape.decoder_begin(), shape.encoder().parameters());
  EXPECT_EQ(shape.parameters(), shape.encoder().parameters() + shape.decoder().parameters());
}

}  // namespace
}  // namespace folk::mpe
