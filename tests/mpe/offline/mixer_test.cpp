// The mixer: weights that are above 0 and add up to 1, whatever its parameters; gradients of finite differences.

#include <folk/games/random.h>
#include <folk/mpe/offline/mixer.h>

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

template <class S>
struct MixerSpecimen {
  MixerShape shape;
  std::vector<S> parameters;
  Matrix<S> states;
  Matrix<S> values;
  MixerTape<S> tape;
  Matrix<S> mixed;

  MixerSpecimen(std::uint64_t seed, std::size_t state, std::size_t count, Index rows, double size = 0.5)
      : shape(state, count),
        parameters(shape.parameters()),
        states(rows, index(state)),
        values(rows, index(count)) {
    RandomStream random({.seed = seed});
    const auto draw = [&](double most) { return static_cast<S>(most * (2 * random.uniform() - 1)); };
    for (S& number : parameters) number = draw(size);
    for (Index i = 0; i < states.size(); ++i) states.data()[i] = draw(1);
    for (Index i = 0; i < values.size(); ++i) values.data()[i] = draw(10);
  }

  static MixerSpecimen any() {
    return {*rc::gen::arbitrary<std::uint64_t>(), *rc::gen::inRange<std::size_t>(1, 9),
            *rc::gen::inRange<std::size_t>(1, 8), *rc::gen::inRange<Index>(1, 6), *rc::gen::element(1e-3, 0.5, 30.0)};
  }

  void run() {
    tape.layer.prepare(shape.layer(), states);
    mixing_weights(shape, parameters.data(), tape);
    mix(tape, values, mixed);
  }
};

RC_GTEST_PROP(Mixer, WeightsAreAboveZeroAndAddUpToOne, ()) {
  auto specimen = MixerSpecimen<float>::any();
  specimen.run();
  const auto& weights = specimen.tape.weights;
  RC_ASSERT(weights.rows() == specimen.states.rows());
  RC_ASSERT(weights.cols() == specimen.values.cols());
  RC_ASSERT(weights.minCoeff() > 0.0F);
  for (Index r = 0; r < weights.rows(); ++r) RC_ASSERT(std::abs(weights.row(r).sum() - 1.0F) <= 1e-5F);
}

RC_GTEST_PROP(Mixer, IsMonotoneAndBetweenItsValues, ()) {
  auto specimen = MixerSpecimen<double>::any();
  specimen.run();
  const Matrix<double> before = specimen.mixed;
  for (Index r = 0; r < before.rows(); ++r) {
    RC_ASSERT(before(r, 0) <= specimen.values.row(r).maxCoeff() + 1e-9);
    RC_ASSERT(before(r, 0) >= specimen.values.row(r).minCoeff() - 1e-9);
  }
  const Index which = *rc::gen::inRange<Index>(0, specimen.values.cols());
  specimen.values.col(which).array() += 1;
  specimen.run();
  for (Index r = 0; r < before.rows(); ++r) RC_ASSERT(specimen.mixed(r, 0) > before(r, 0));
}

RC_GTEST_PROP(Mixer, IsThatOfItsDefinition, ()) {
  auto specimen = MixerSpecimen<double>::any();
  specimen.run();
  for (std::size_t r = 0; r < static_cast<std::size_t>(specimen.states.rows()); ++r) {
    const double plain = test::plain_mix(specimen.shape.layer(), specimen.parameters.data(),
                                         test::row_of(specimen.states, r), test::row_of(specimen.values, r));
    RC_ASSERT(std::abs(specimen.mixed(index(r), 0) - plain) <= 1e-10);
  }
}

TEST(Mixer, GivesAllTheSameWhereItHasNothingToSay) {
  MixerSpecimen<float> specimen(1, 3, 6, 2, 0);
  specimen.run();
  EXPECT_LE((specimen.tape.weights.array() - 1.0F / 6).abs().maxCoeff(), 1e-6F);
}

/// The sum of what the rows are mixed to, each times its weight.
double outcome(MixerSpecimen<double>& specimen, const Matrix<double>& weights) {
  specimen.run();
  return (specimen.mixed.array() * weights.array()).sum();
}

TEST(Mixer, GradientsAreThoseOfFiniteDifferences) {
  for (const std::uint64_t seed : {1, 2}) {
    MixerSpecimen<double> specimen(seed, 3, 6, 4);
    Matrix<double> weights(4, 1);
    weights << 1, -2, 0.5, 3;
    specimen.run();
    std::vector<double> gradient(specimen.parameters.size(), 7.0);  // it is added to what is there
    mixer_backward(specimen.shape, specimen.parameters.data(), specimen.tape, specimen.values, specimen.mixed, weights,
                   gradient.data());
    const Matrix<double> shares = specimen.tape.weights;
    const auto sum = [&] { return outcome(specimen, weights); };
    for (std::size_t i = 0; i < gradient.size(); ++i)
      EXPECT_NEAR(gradient[i] - 7, test::difference(specimen.parameters[i], sum), 1e-7) << i;
    for (Index r = 0; r < 4; ++r)
      for (Index i = 0; i < 6; ++i)
        EXPECT_NEAR(weights(r, 0) * shares(r, i), test::difference(specimen.values(r, i), sum), 1e-7);
  }
}

TEST(MixerShape, IsOneLayer) {
  const MixerShape shape(48, 6);
  EXPECT_EQ(shape.values(), 6U);
  EXPECT_EQ(shape.layer(), MlpShape({48, 32 * 7}));
  EXPECT_EQ(shape.parameters(), shape.layer().parameters());
}

}  // namespace
}  // namespace folk::mpe
