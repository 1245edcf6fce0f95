// Batch normalisation against numbers worked out by hand, finite differences in double, and what the players do with
// the numbers that it remembers.

#include <folk/games/random.h>
#include <folk/mpe/network/batch_norm.h>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace folk::mpe {
namespace {

void fill(RandomStream& random, Matrix<double>& matrix, double size = 1) {
  for (Index i = 0; i < matrix.size(); ++i) matrix.data()[i] = size * (2 * random.uniform() - 1);
}

Matrix<double> matrix_of(Index rows, Index columns, const std::vector<double>& numbers) {
  return Eigen::Map<const Matrix<double>>(numbers.data(), rows, columns);
}

// Columns (1, 2, 6) and (-1, -1, 5): means 3 and 1, mean squares about them 14/3 and 8.
const Matrix<double> by_hand = matrix_of(3, 2, {1, -1, 2, -1, 6, 5});

TEST(BatchNorm, IsThatOfNumbersWorkedOutByHand) {
  const std::array<double, 2> weight{2, -1};
  const std::array<double, 2> bias{10, 0.5};
  BatchNormTape<double> tape;
  Matrix<double> y;
  batch_norm(by_hand, weight.data(), bias.data(), tape, y);
  const double first = std::sqrt(14.0 / 3 + 1e-5);
  const double second = std::sqrt(8 + 1e-5);
  const Matrix<double> wanted = matrix_of(
      3, 2, {10 - 4 / first, 0.5 + 2 / second, 10 - 2 / first, 0.5 + 2 / second, 10 + 6 / first, 0.5 - 4 / second});
  EXPECT_LE((y - wanted).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_DOUBLE_EQ(tape.mean[0], 3);
  EXPECT_DOUBLE_EQ(tape.mean[1], 1);
  EXPECT_DOUBLE_EQ(tape.variance[0], 14.0 / 3);
  EXPECT_DOUBLE_EQ(tape.variance[1], 8);
}

TEST(BatchNorm, RemembersATenthOfEachBatchAndVariancesWithoutBias) {
  const std::array<double, 2> weight{1, 1};
  const std::array<double, 2> bias{0, 0};
  BatchNormTape<double> tape;
  Matrix<double> y;
  batch_norm(by_hand, weight.data(), bias.data(), tape, y);
  std::vector<float> mean(2, 0.0F);
  std::vector<float> variance(2, 1.0F);
  remember_batch(tape, mean, variance);
  EXPECT_FLOAT_EQ(mean[0], 0.3F);
  EXPECT_FLOAT_EQ(mean[1], 0.1F);
  EXPECT_FLOAT_EQ(variance[0], 0.9F + 0.7F);  // 14 / 2
  EXPECT_FLOAT_EQ(variance[1], 0.9F + 1.2F);  // 24 / 2
  for (int i = 0; i < 300; ++i) remember_batch(tape, mean, variance);
  EXPECT_NEAR(mean[0], 3, 1e-5);
  EXPECT_NEAR(variance[1], 12, 1e-4);
}

TEST(BatchNorm, OfAColumnThatNeverChangesIsItsBias) {
  const Matrix<float> x = Matrix<float>::Constant(7, 1, 1000.25F);
  const float weight = 3;
  const float bias = -2;
  BatchNormTape<float> tape;
  Matrix<float> y;
  batch_norm(x, &weight, &bias, tape, y);
  EXPECT_EQ(y, (Matrix<float>::Constant(7, 1, -2.0F)));
}

TEST(BatchNorm, OfFloatsIsExactFarFromZero) {
  // 4096 rows about 1000: sums of squares in float would leave nothing of a variance of 1e-2.
  RandomStream random;
  Matrix<double> noise(4096, 1);
  fill(random, noise, 0.1);
  const Matrix<float> x = (noise.array() + 1000).cast<float>();
  const float weight = 1;
  const float bias = 0;
  BatchNormTape<float> tape;
  Matrix<float> y;
  batch_norm(x, &weight, &bias, tape, y);
  const Matrix<double> exact = x.cast<double>();
  const double mean = exact.mean();
  EXPECT_NEAR(tape.mean[0], mean, 1e-10);
  EXPECT_NEAR(tape.variance[0], (exact.array() - mean).square().mean(), 1e-12);
  EXPECT_NEAR(y.cast<double>().squaredNorm() / 4096, 1, 0.01);
}

/// The sum of all outputs, each times its weight.
struct Objective {
  Matrix<double> x;
  std::vector<double> numbers;  // weight, then bias
  Matrix<double> weights;

  double operator()() const {
    BatchNormTape<double> tape;
    Matrix<double> y;
    batch_norm(x, numbers.data(), numbers.data() + x.cols(), tape, y);
    return (y.array() * weights.array()).sum();
  }

  /// By the five-point rule.
  double slope(double& number) const {
    const double h = 1e-3;
    const double here = number;
    const auto at = [&](double step) {
      number = here + step * h;
      const double value = (*this)();
      number = here;
      return value;
    };
    return (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * h);
  }
};

Objective any_objective() {
  RandomStream random({.seed = *rc::gen::arbitrary<std::uint64_t>()});
  Objective objective;
  objective.x.resize(*rc::gen::inRange<Index>(2, 40), *rc::gen::inRange<Index>(1, 12));
  objective.weights.resizeLike(objective.x);
  fill(random, objective.x, 2);
  objective.x.array() += 1;
  fill(random, objective.weights);
  for (Index i = 0; i < 2 * objective.x.cols(); ++i) objective.numbers.push_back(2 * random.uniform() - 1);
  // Two rows that are nearly the same leave no room for a step of finite differences.
  objective.x(0, 0) = 3;
  for (Index c = 0; c < objective.x.cols(); ++c) objective.x(1, c) = objective.x(0, c) + 1.5;
  return objective;
}

RC_GTEST_PROP(BatchNorm, GradientsAreThoseOfFiniteDifferences, ()) {
  auto objective = any_objective();
  const Index inputs = objective.x.cols();
  BatchNormTape<double> tape;
  Matrix<double> y, dx;
  batch_norm(objective.x, objective.numbers.data(), objective.numbers.data() + inputs, tape, y);
  std::vector<double> gradient(objective.numbers.size(), 100.0);  // added to
  batch_norm_backward(objective.weights, tape, gradient.data(), gradient.data() + inputs);
  const auto close = [&](double derivative, double& number) {
    const double slope = objective.slope(number);
    RC_ASSERT(std::abs(derivative - slope) <= 1e-8 * std::max({1.0, std::abs(slope), std::abs(objective())}));
  };
  for (std::size_t i = 0; i < gradient.size(); ++i) close(gradient[i] - 100, objective.numbers[i]);
  const Index first = *rc::gen::inRange<Index>(0, inputs);
  const Index count = *rc::gen::inRange<Index>(1, inputs - first + 1);
  const Matrix<double> dy = objective.weights.middleCols(first, count);
  batch_norm_input_backward(dy, objective.numbers.data(), tape, {first, count}, dx);
  RC_ASSERT(dx.rows() == dy.rows());
  RC_ASSERT(dx.cols() == count);
  for (const Index row : {Index{0}, Index{1}, dx.rows() - 1})
    for (Index c = 0; c < count; ++c) close(dx(row, c), objective.x(row, first + c));
}

// ---- networks behind one ---------------------------------------------------------------------------------------

TEST(NormalisedShape, LaysNetworksOutAfterTheNormalisation) {
  const NormalisedShape shape(MlpShape({3, 5, 1}), 2);
  EXPECT_EQ(shape.inputs(), 3U);
  EXPECT_EQ(shape.bias(), 3U);
  EXPECT_EQ(shape.network_begin(0), 6U);
  EXPECT_EQ(shape.network_begin(1), 6U + 26U);
  EXPECT_EQ(shape.parameters(), 6U + 52U);
}

TEST(NormalisedNetworks, StartAsPlainOnesBehindNothing) {
  const NormalisedShape shape(MlpShape({3, 5, 2}), 2);
  const auto& network = shape.network();
  const auto parameters = initial_parameters(shape, 4, 30, 3e-3);
  ASSERT_EQ(parameters.size(), shape.parameters());
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(parameters[i], i < 3 ? 1 : 0);
  for (std::size_t k = 0; k < 2; ++k) {
    const auto plain = initial_parameters(network, 4, 30 + k);
    for (std::size_t i = 0; i < plain.size(); ++i) {
      const float number = parameters[shape.network_begin(k) + i];
      if (i >= network.weight(1) && i < network.bias(1))
        EXPECT_TRUE(number != 0 && std::abs(number) <= 3e-3F) << number;
      else
        EXPECT_EQ(number, plain[i]);
    }
  }
  const auto wide = initial_parameters(shape, 4, 30);
  EXPECT_EQ(std::vector<float>(wide.begin() + 6, wide.begin() + 6 + 32), initial_parameters(network, 4, 30));
}

/// Twin networks without hidden layers: smooth, so that finite differences say all.
RC_GTEST_PROP(NormalisedNetworks, GradientsAreThoseOfFiniteDifferences, ()) {
  auto objective = any_objective();
  const NormalisedShape shape(MlpShape({static_cast<std::size_t>(objective.x.cols()), 2}), 2);
  RandomStream random({.seed = 3});
  std::vector<double> parameters(shape.parameters());
  for (double& parameter : parameters) parameter = 2 * random.uniform() - 1;
  std::array<Matrix<double>, 2> weights;
  for (auto& matrix : weights) {
    matrix.resize(objective.x.rows(), 2);
    fill(random, matrix);
  }
  NormalisedTape<double> tape;
  const auto value = [&](std::size_t networks) {
    tape.input = objective.x;
    forward(shape, parameters.data(), tape, networks);
    double sum = 0;
    for (std::size_t k = 0; k < networks; ++k) sum += (tape.output(k).array() * weights[k].array()).sum();
    return sum;
  };
  const auto slope = [&](double& number, std::size_t networks) {
    const double here = number;
    const auto at = [&](double step) {
      number = here + step;
      const double there = value(networks);
      number = here;
      return there;
    };
    return (8 * (at(1e-3) - at(-1e-3)) - (at(2e-3) - at(-2e-3))) / 12e-3;
  };
  const double size = std::max(1.0, std::abs(value(2)));
  std::vector<double> gradient(shape.parameters(), 0.0);
  backward<double>(shape, parameters.data(), tape, weights, gradient.data());
  for (std::size_t i = 0; i < gradient.size(); ++i) {
    const double wanted = slope(parameters[i], 2);
    RC_ASSERT(std::abs(gradient[i] - wanted) <= 1e-8 * std::max(size, std::abs(wanted)));
  }
  value(1);
  Matrix<double> dx;
  const Index last = objective.x.cols() - 1;
  input_backward(shape, parameters.data(), tape, weights[0], {last, 1}, dx);
  for (const Index row : {Index{0}, Index{1}}) {
    const double wanted = slope(objective.x(row, last), 1);
    RC_ASSERT(std::abs(dx(row, 0) - wanted) <= 1e-8 * std::max(size, std::abs(wanted)));
  }
}

// ---- remembered numbers ----------------------------------------------------------------------------------------

RC_GTEST_PROP(RememberedNormalisation, IsWhatActorsSee, ()) {
  RandomStream random({.seed = *rc::gen::arbitrary<std::uint64_t>()});
  PolicyNetwork network;
  network.shape = MlpShape({4, 2});
  network.parameters = initial_parameters(network.shape, 1, 1);
  InputNormalisation normalisation;
  for (int k = 0; k < 4; ++k) {
    normalisation.weight.push_back(static_cast<float>(random.uniform() + 0.5));
    normalisation.bias.push_back(static_cast<float>(random.uniform() - 0.5));
    normalisation.mean.push_back(static_cast<float>(4 * random.uniform() - 2));
    normalisation.variance.push_back(static_cast<float>(random.uniform()));
  }
  network.normalisation = normalisation;
  auto plain = network;
  plain.normalisation.reset();
  Matrix<double> x(5, 4);
  fill(random, x, 3);
  const Matrix<float> observations = x.cast<float>();
  Actor<float> with(network), without(plain);
  with.observations(5) = observations;
  with.act();
  Matrix<float> normalised = observations;
  normalise(normalisation, normalised);
  without.observations(5) = normalised;
  without.act();
  RC_ASSERT(with.raw() == without.raw());
  RC_ASSERT(with.raw() != (without.observations(5) = observations, without.act(), without.raw()));
}

TEST(RememberedNormalisation, IsTheBatchsOwnForARememberedBatch) {
  RandomStream random;
  Matrix<double> x(500, 3);
  fill(random, x, 2);
  const std::array<double, 6> numbers{1, 2, -1, 0, 0.5, 3};
  BatchNormTape<double> tape;
  Matrix<double> y;
  batch_norm(x, numbers.data(), numbers.data() + 3, tape, y);
  InputNormalisation remembered{{1, 2, -1}, {0, 0.5F, 3}, std::vector<float>(3), std::vector<float>(3)};
  for (int i = 0; i < 300; ++i) remember_batch(tape, remembered.mean, remembered.variance);
  Matrix<double> z = x;
  normalise(remembered, z);
  EXPECT_LE((y - z).cwiseAbs().maxCoeff(), 0.01);  // the variances differ by a part in 500
}

}  // namespace
}  // namespace folk::mpe
