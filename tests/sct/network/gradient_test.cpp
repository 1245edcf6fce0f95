// Analytic gradients against finite differences, on random architectures and batches.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <sct/network/random_network.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace folk::sct {
namespace {

using Parameters = std::vector<double>;

/// One random problem: a loss as a function of the parameters.
class Problem {
public:
  Problem(LossMode mode, std::uint64_t seed)
      : draw_(seed),
        mode_(mode),
        network_(test::random_architecture(mode, draw_)),
        parameters_(test::random_parameters<double>(network_.architecture(), draw_)),
        batch_(test::random_batch<double>(network_.architecture(), draw_.between(1, 3), draw_)),
        loss_(network_, mode),
        policy_loss_(network_, LossMode::action_only),
        frozen_(batch_) {
    if (draw_.chance(0.5)) dropouts_ = {Dropout(0.25, seed, 3, 0), Dropout(0.25, seed, 3, 1)};
    gradient_.resize(parameters_.size());
    run(loss_, batch_, dropouts_, parameters_, gradient_.data());
    frozen_.opponent = loss_.fed();
  }

  const Network<double>& network() const { return network_; }
  const Parameters& parameters() const { return parameters_; }
  const Parameters& gradient() const { return gradient_; }
  test::Draw& draw() { return draw_; }
  bool untouched(const Tensor& tensor) const { return loss_.untouched(tensor); }

  /// The function that gradient() is the gradient of. In `selfconf` the slots of the second pass hold what the beliefs
  /// were at parameters(), whatever `at` makes of them: belief loss of the first pass, the rest by a loss that takes
  /// its slots as given.
  double value(const Parameters& at) {
    const auto losses = run(loss_, batch_, dropouts_, at, nullptr);
    if (mode_ != LossMode::selfconf) return losses.total();
    return losses.belief + run(policy_loss_, frozen_, {dropouts_[1], dropouts_[1]}, at, nullptr).total();
  }

private:
  static Losses run(SelfConfirmingLoss<double>& loss, const Batch<double>& batch,
                    const std::array<Dropout, 2>& dropouts, const Parameters& at, double* gradient) {
    const Chunk<double> chunk{batch, 0, 0, batch.window_rounds};
    return loss(at.data(), chunk, Denominators<double>(batch), dropouts, gradient);
  }

  test::Draw draw_;
  LossMode mode_;
  Network<double> network_;
  Parameters parameters_;
  Batch<double> batch_;
  SelfConfirmingLoss<double> loss_;
  SelfConfirmingLoss<double> policy_loss_;
  Batch<double> frozen_;
  std::array<Dropout, 2> dropouts_;
  Parameters gradient_;
};

/// How far the derivative along `direction` is from the best of the central and the two one-sided differences: where a
/// ReLU turns within the step on one side, the other side's still tells the truth.
double error_along(Problem& problem, const Parameters& direction) {
  constexpr double step = 2e-7;
  const auto& here = problem.parameters();
  const auto moved = [&](double by) {
    auto at = here;
    for (std::size_t i = 0; i < at.size(); ++i) at[i] += by * direction[i];
    return problem.value(at);
  };
  double slope = 0;
  for (std::size_t i = 0; i < here.size(); ++i) slope += problem.gradient()[i] * direction[i];
  const double before = moved(-step);
  const double now = problem.value(here);
  const double after = moved(step);
  const double error = std::min({std::abs((after - before) / (2 * step) - slope),
                                 std::abs((after - now) / step - slope), std::abs((now - before) / step - slope)});
  return error / (1 + std::abs(slope));
}

void check_gradient(LossMode mode) {
  Problem problem(mode, *rc::gen::arbitrary<std::uint64_t>().as("seed"));
  for (const auto& tensor : problem.network().layout().tensors()) {
    Parameters direction(problem.parameters().size());
    double length = 0;
    for (std::size_t i = 0; i < tensor.size(); ++i) {
      double& x = direction[tensor.offset + i];
      x = problem.draw().normal();
      length += x * x;
    }
    for (double& x : direction) x /= std::sqrt(length);
    RC_LOG() << tensor.name << '\n';
    RC_ASSERT(error_along(problem, direction) < 1e-5);

    std::fill(direction.begin(), direction.end(), 0.0);
    direction[tensor.offset + problem.draw().between(0, tensor.size() - 1)] = 1;
    RC_ASSERT(error_along(problem, direction) < 1e-5);

    const std::span<const double> gradient(problem.gradient().data() + tensor.offset, tensor.size());
    if (problem.untouched(tensor))
      RC_ASSERT(std::all_of(gradient.begin(), gradient.end(), [](double g) { return g == 0; }));
  }
}

RC_GTEST_PROP(Gradient, OfTeacherIsRight, ()) { check_gradient(LossMode::teacher); }
RC_GTEST_PROP(Gradient, OfSelfconfIsRightWithTheSlotsHeldFixed, ()) { check_gradient(LossMode::selfconf); }
RC_GTEST_PROP(Gradient, OfCompositeIsRightThroughTheSlots, ()) { check_gradient(LossMode::composite); }
RC_GTEST_PROP(Gradient, OfActionOnlyIsRight, ()) { check_gradient(LossMode::action_only); }

/// A window's states do not depend on its neighbours, nor on later rounds.
RC_GTEST_PROP(Forward, OfAWindowIsItsOwnAndCausal, ()) {
  test::Draw draw(*rc::gen::arbitrary<std::uint64_t>().as("seed"));
  const Network<double> network(test::random_architecture(LossMode::teacher, draw));
  const auto& architecture = network.architecture();
  const auto parameters = test::random_parameters<double>(architecture, draw);
  auto batch = test::random_batch<double>(architecture, 3, draw);
  std::vector<std::size_t> every;
  for (std::size_t token = 0; token < architecture.round_tokens(); ++token) every.push_back(token);
  const Dropout none;
  const auto states = [&](const Chunk<double>& chunk) {
    NetworkTape<double> tape;
    network.forward(parameters.data(), chunk, {batch.opponent, none, every}, tape);
    return tape.hidden;
  };
  const Matrix<double> all = states({batch, 0, 0, batch.window_rounds});
  const auto round_rows = index(architecture.round_tokens());
  const std::size_t second = batch.window_rounds[0];
  const std::size_t length = batch.window_rounds[1];
  const std::size_t known = draw.between(1, length);
  for (std::size_t t = second + known; t < second + length; ++t) batch.returns[t] += 1;
  const std::array<std::size_t, 1> rounds{length};
  const Matrix<double> alone = states({batch, 1, second, rounds});
  const auto rows = index(known) * round_rows;
  const double error = (alone.topRows(rows) - all.middleRows(index(second) * round_rows, rows)).cwiseAbs().maxCoeff();
  RC_ASSERT(error < 1e-12);
}

}  // namespace
}  // namespace folk::sct
