#include <folk/games/random.h>
#include <folk/mpe/network/mlp.h>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

#include "games/expect_error.h"

namespace folk::mpe {
namespace {

using folk::test::expect_error;

template <class S>
void fill(RandomStream& random, S* numbers, std::size_t count, double size = 1) {
  for (std::size_t i = 0; i < count; ++i) numbers[i] = static_cast<S>(size * (2 * random.uniform() - 1));
}

/// A network of one to five layers with numbers in it, and an input.
template <class S>
struct Specimen {
  MlpShape shape;
  std::vector<S> parameters;
  Matrix<S> input;

  static Specimen any() {
    const auto layers = *rc::gen::inRange<std::size_t>(1, 6);
    auto widths = *rc::gen::container<std::vector<std::size_t>>(layers + 1, rc::gen::inRange<std::size_t>(1, 71));
    RandomStream random({.seed = *rc::gen::arbitrary<std::uint64_t>()});
    Specimen specimen;
    specimen.shape = MlpShape(std::move(widths));
    specimen.parameters.resize(specimen.shape.parameters());
    fill(random, specimen.parameters.data(), specimen.parameters.size(), 0.5);
    specimen.input.resize(*rc::gen::inRange<Index>(1, 71), index(specimen.shape.inputs()));
    fill(random, specimen.input.data(), static_cast<std::size_t>(specimen.input.size()));
    return specimen;
  }

  /// The tape of a forward pass.
  MlpTape<S> forward() const {
    MlpTape<S> tape;
    tape.prepare(shape, static_cast<std::size_t>(input.rows()));
    tape.input() = input;
    mpe::forward(shape, parameters.data(), tape);
    return tape;
  }
};

/// The sum of all outputs, each times its weight, and which units were on.
struct Outcome {
  double sum = 0;
  std::vector<bool> on;
};

Outcome outcome(const Specimen<double>& specimen, const Matrix<double>& weights) {
  const auto tape = specimen.forward();
  Outcome outcome{(tape.output().array() * weights.array()).sum(), {}};
  for (std::size_t k = 1; k + 1 < tape.values.size(); ++k)
    for (Index i = 0; i < tape.values[k].size(); ++i) outcome.on.push_back(tape.values[k].data()[i] > 0);
  return outcome;
}

/// Whether a derivative is that of finite differences. In any one number the outcome is a straight line as long as no
/// unit goes on or off: the step may be large, and where one does there is nothing to compare.
bool is_derivative(double derivative, double& number, const Specimen<double>& specimen, const Matrix<double>& weights,
                   int& compared) {
  const double h = 1e-3;
  const double here = number;
  number = here + h;
  const Outcome above = outcome(specimen, weights);
  number = here - h;
  const Outcome below = outcome(specimen, weights);
  number = here;
  if (above.on != below.on) return true;
  ++compared;
  const double size = std::max({1.0, std::abs(above.sum), std::abs(below.sum), std::abs(derivative)});
  return std::abs((above.sum - below.sum) / (2 * h) - derivative) <= 1e-9 * size;
}

RC_GTEST_PROP(Mlp, GradientsAreThoseOfFiniteDifferences, ()) {
  auto specimen = Specimen<double>::any();
  RandomStream random;
  Matrix<double> weights(specimen.input.rows(), index(specimen.shape.outputs()));
  fill(random, weights.data(), static_cast<std::size_t>(weights.size()));
  auto tape = specimen.forward();
  std::vector<double> gradient(specimen.parameters.size(), 0.0);
  Matrix<double> input_gradient;
  backward(specimen.shape, specimen.parameters.data(), tape, weights, gradient.data(), &input_gradient,
           {0, specimen.input.cols()});
  RC_ASSERT(input_gradient.rows() == specimen.input.rows());
  RC_ASSERT(input_gradient.cols() == specimen.input.cols());
  int compared = 0;
  const auto below = [&](std::size_t count) { return static_cast<std::size_t>(random() % count); };
  for (std::size_t layer = 0; layer < specimen.shape.layers(); ++layer)
    for (const std::size_t at :
         {specimen.shape.weight(layer) + below(specimen.shape.bias(layer) - specimen.shape.weight(layer)),
          specimen.shape.bias(layer) + below(specimen.shape.widths()[layer + 1])})
      RC_ASSERT(is_derivative(gradient[at], specimen.parameters[at], specimen, weights, compared));
  for (int k = 0; k < 2; ++k) {
    const auto at = static_cast<Index>(below(static_cast<std::size_t>(specimen.input.size())));
    RC_ASSERT(is_derivative(input_gradient.data()[at], specimen.input.data()[at], specimen, weights, compared));
  }
  RC_CLASSIFY(compared == 0, "nothing compared");
  RC_TAG(compared > 0);
}

// The rule in its plainest form.
RC_GTEST_PROP(Mlp, IsLayerAfterLayerOfSums, ()) {
  const auto specimen = Specimen<double>::any();
  const auto tape = specimen.forward();
  const auto& shape = specimen.shape;
  const auto row = *rc::gen::inRange<Index>(0, specimen.input.rows());
  std::vector<double> values(specimen.input.row(row).begin(), specimen.input.row(row).end());
  for (std::size_t layer = 0; layer < shape.layers(); ++layer) {
    std::vector<double> sums;
    for (std::size_t unit = 0; unit < shape.widths()[layer + 1]; ++unit) {
      const double* weights = specimen.parameters.data() + shape.weight(layer) + unit * values.size();
      const double bias = specimen.parameters[shape.bias(layer) + unit];
      const double sum = std::inner_product(values.begin(), values.end(), weights, bias);
      sums.push_back(layer + 1 < shape.layers() ? std::max(sum, 0.0) : sum);
    }
    values = sums;
  }
  RC_ASSERT(tape.output().rows() == specimen.input.rows());
  for (std::size_t i = 0; i < values.size(); ++i)
    RC_ASSERT(std::abs(tape.output()(row, index(i)) - values[i]) <= 1e-11 * std::max(1.0, std::abs(values[i])));
}

RC_GTEST_PROP(Mlp, SomeColumnsOfTheInputsGradientAreThoseOfTheWhole, ()) {
  const auto specimen = Specimen<double>::any();
  auto tape = specimen.forward();
  const Matrix<double> ones = Matrix<double>::Ones(specimen.input.rows(), index(specimen.shape.outputs()));
  Matrix<double> whole, some;
  const double* parameters = specimen.parameters.data();
  backward<double>(specimen.shape, parameters, tape, ones, nullptr, &whole, {0, specimen.input.cols()});
  const Index first = *rc::gen::inRange<Index>(0, specimen.input.cols());
  const Index count = *rc::gen::inRange<Index>(1, specimen.input.cols() - first + 1);
  backward<double>(specimen.shape, parameters, tape, ones, nullptr, &some, {first, count});
  RC_ASSERT(some.rows() == whole.rows());
  RC_ASSERT(some.cols() == count);
  const double size = std::max(1.0, whole.cwiseAbs().maxCoeff());
  RC_ASSERT((some - whole.middleCols(first, count)).cwiseAbs().maxCoeff() <= 1e-12 * size);
}

RC_GTEST_PROP(Mlp, TheGradientIsAddedToWhatIsThere, ()) {
  const auto specimen = Specimen<double>::any();
  auto tape = specimen.forward();
  const Matrix<double> ones = Matrix<double>::Ones(specimen.input.rows(), index(specimen.shape.outputs()));
  std::vector<double> fresh(specimen.parameters.size(), 0.0);
  backward<double>(specimen.shape, specimen.parameters.data(), tape, ones, fresh.data(), nullptr);
  RandomStream random;
  std::vector<double> before(fresh.size());
  fill(random, before.data(), before.size(), 100);
  auto sum = before;
  backward<double>(specimen.shape, specimen.parameters.data(), tape, ones, sum.data(), nullptr);
  for (std::size_t i = 0; i < sum.size(); ++i) {
    const double wanted = before[i] + fresh[i];
    RC_ASSERT(std::abs(sum[i] - wanted) <= 1e-12 * (100 + std::abs(wanted)));
  }
}

/// Forward passes of some rows alone, against those rows among all.
template <class S>
void expect_rows_of_their_own() {
  const auto all = Specimen<S>::any();
  const Matrix<S> together = all.forward().output();
  auto some = all;
  const Index first = *rc::gen::inRange<Index>(0, all.input.rows());
  const Index count = *rc::gen::inRange<Index>(1, all.input.rows() - first + 1);
  some.input = all.input.middleRows(first, count);
  RC_ASSERT(some.forward().output() == together.middleRows(first, count));
}

RC_GTEST_PROP(Mlp, ARowDoesNotDependOnItsNeighboursInFloat, ()) { expect_rows_of_their_own<float>(); }
RC_GTEST_PROP(Mlp, ARowDoesNotDependOnItsNeighboursInDouble, ()) { expect_rows_of_their_own<double>(); }

RC_GTEST_PROP(Mlp, AnInputThatStaysWhereItIsIsAsGood, ()) {
  const auto specimen = Specimen<float>::any();
  auto own = specimen.forward();
  MlpTape<float> shared;
  shared.prepare(specimen.shape, specimen.input);
  forward(specimen.shape, specimen.parameters.data(), shared);
  RC_ASSERT(shared.output() == own.output());
  const Matrix<float> ones = Matrix<float>::Ones(specimen.input.rows(), index(specimen.shape.outputs()));
  std::vector<float> one(specimen.parameters.size()), other(one.size());
  backward<float>(specimen.shape, specimen.parameters.data(), own, ones, one.data(), nullptr);
  backward<float>(specimen.shape, specimen.parameters.data(), shared, ones, other.data(), nullptr);
  RC_ASSERT(one == other);
  // And then an input of its own again.
  auto turned = specimen;
  turned.input = -specimen.input;
  shared.prepare(specimen.shape, static_cast<std::size_t>(specimen.input.rows()));
  shared.input() = turned.input;
  forward(specimen.shape, specimen.parameters.data(), shared);
  RC_ASSERT(shared.output() == turned.forward().output());
}

TEST(MlpShape, LaysTheLayersOut) {
  const MlpShape shape({3, 5, 2});
  EXPECT_EQ(shape.layers(), 2U);
  EXPECT_EQ(shape.inputs(), 3U);
  EXPECT_EQ(shape.outputs(), 2U);
  EXPECT_EQ(shape.weight(0), 0U);
  EXPECT_EQ(shape.bias(0), 15U);
  EXPECT_EQ(shape.weight(1), 20U);
  EXPECT_EQ(shape.bias(1), 30U);
  EXPECT_EQ(shape.parameters(), 32U);
  EXPECT_EQ(shape, MlpShape({3, 5, 2}));
  EXPECT_NE(shape, MlpShape({3, 5, 3}));
  for (const std::vector<std::size_t>& widths : {std::vector<std::size_t>{}, std::vector<std::size_t>{4}})
    expect_error<UsageError>([&] { MlpShape{widths}; }, "expected inputs, then outputs");
}

// ---- initial parameters ----------------------------------------------------------------------------------------

/// The largest size, and the mean, of the parameters of a layer.
void expect_uniform_within(const MlpShape& shape, const std::vector<float>& parameters, std::size_t layer,
                           double width) {
  double largest = 0;
  double sum = 0;
  const std::size_t end = shape.bias(layer) + shape.widths()[layer + 1];
  for (std::size_t i = shape.weight(layer); i < end; ++i) {
    largest = std::max(largest, std::abs(static_cast<double>(parameters[i])));
    sum += static_cast<double>(parameters[i]);
  }
  const double count = static_cast<double>(end - shape.weight(layer));
  EXPECT_LE(largest, width * (1 + 1e-7)) << layer;
  EXPECT_GT(largest, width * 0.95) << layer;
  EXPECT_NEAR(sum / count, 0, 4 * width / std::sqrt(3 * count)) << layer;
}

TEST(InitialParameters, AreUniformWithinWhatALayersInputsAllow) {
  const MlpShape shape({16, 64, 50, 2});
  const auto parameters = initial_parameters(shape, 5, 0);
  ASSERT_EQ(parameters.size(), shape.parameters());
  expect_uniform_within(shape, parameters, 0, 1 / std::sqrt(16.0));
  expect_uniform_within(shape, parameters, 1, 1 / std::sqrt(64.0));
  expect_uniform_within(shape, parameters, 2, 1 / std::sqrt(50.0));
  const auto small = initial_parameters(shape, 5, 0, 3e-3);
  expect_uniform_within(shape, small, 2, 3e-3);
  EXPECT_TRUE(
      std::equal(small.begin(), small.begin() + static_cast<std::ptrdiff_t>(shape.weight(2)), parameters.begin()));
}

TEST(InitialParameters, DependOnSeedAndNetworkAlone) {
  const MlpShape shape({14, 8, 2});
  const auto one = initial_parameters(shape, 5, 1);
  EXPECT_EQ(one, initial_parameters(shape, 5, 1));
  for (const auto& other : {initial_parameters(shape, 6, 1), initial_parameters(shape, 5, 2)})
    for (std::size_t i = 0; i < one.size(); ++i) EXPECT_NE(one[i], other[i]);
}

}  // namespace
}  // namespace folk::mpe
