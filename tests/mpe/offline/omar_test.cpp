// OMAR's losses against their definitions written down plainly and against finite differences in double, its search
// against functions whose best action is known, and the learner against what its parts say.

#include <folk/mpe/offline/omar.h>
#include <folk/mpe/players/policy_file.h>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "games/expect_error.h"
#include "mpe/data/small_data_set.h"
#include "mpe/offline/saved_learner.h"

namespace folk::mpe {
namespace {

using folk::test::expect_error;
using test::learner_record;
using test::load;
using test::saved;

void fill(RandomStream& random, Matrix<double>& matrix, double size = 1) {
  for (Index i = 0; i < matrix.size(); ++i) matrix.data()[i] = size * (2 * random.uniform() - 1);
}

std::vector<double> doubles(const std::vector<float>& numbers) { return {numbers.begin(), numbers.end()}; }

// ---- the definitions, written down plainly ---------------------------------------------------------------------

/// Rows of (o, a).
Matrix<double> joined(const Matrix<double>& observations, const Matrix<double>& actions) {
  const Index each = actions.rows() / observations.rows();
  Matrix<double> rows(actions.rows(), observations.cols() + 2);
  for (Index r = 0; r < rows.rows(); ++r) rows.row(r) << observations.row(r / each), actions.row(r);
  return rows;
}

/// Outputs [rows, outputs] of network k behind the normalisation of these rows by their own numbers.
Matrix<double> plain_outputs(const NormalisedShape& shape, const std::vector<double>& parameters, std::size_t k,
                             const Matrix<double>& input) {
  Matrix<double> x = input;
  for (Index c = 0; c < x.cols(); ++c) {
    const double mean = x.col(c).mean();
    const double variance = (x.col(c).array() - mean).square().mean();
    const double weight = parameters[static_cast<std::size_t>(c)];
    const double bias = parameters[shape.inputs() + static_cast<std::size_t>(c)];
    x.col(c) = (x.col(c).array() - mean) / std::sqrt(variance + 1e-5) * weight + bias;
  }
  const auto& network = shape.network();
  const double* numbers = parameters.data() + shape.network_begin(k);
  for (std::size_t layer = 0; layer < network.layers(); ++layer) {
    const auto rows = index(network.widths()[layer + 1]);
    const Eigen::Map<const Matrix<double>> weight(numbers + network.weight(layer), rows, x.cols());
    const Eigen::Map<const Matrix<double>> bias(numbers + network.bias(layer), 1, rows);
    Matrix<double> y = (x * weight.transpose()).rowwise() + bias.row(0);
    if (layer + 1 < network.layers()) y = y.cwiseMax(0.0);
    x = y;
  }
  return x;
}

/// A predator's networks and a batch, all small and in double.
struct OmarSpecimen {
  NormalisedShape actor_shape{MlpShape({3, 5, 4, 2}), 1};
  NormalisedShape critic_shape{MlpShape({5, 6, 4, 1}), 2};
  std::vector<double> actor, critic, target_actor, target_critic;
  Transitions<double> batch;
  Matrix<double> targets, uniform, best;
  OmarScratch<double> scratch;

  explicit OmarSpecimen(std::uint64_t seed, Index rows = 9) {
    RandomStream random({.seed = seed});
    const auto numbers = [&](const NormalisedShape& shape) {
      std::vector<double> parameters(shape.parameters());
      for (double& parameter : parameters) parameter = 2 * random.uniform() - 1;
      return parameters;
    };
    actor = numbers(actor_shape), target_actor = numbers(actor_shape);
    critic = numbers(critic_shape), target_critic = numbers(critic_shape);
    const auto matrix = [&](Matrix<double>& there, Index height, Index width, double size = 1) {
      there.resize(height, width);
      fill(random, there, size);
    };
    matrix(batch.observations, rows, 3, 2), matrix(batch.next_observations, rows, 3, 2);
    matrix(batch.actions, rows, 2), matrix(batch.rewards, rows, 1, 5), matrix(batch.dones, rows, 1);
    batch.dones = (batch.dones.array() > 0.5).cast<double>();
    matrix(targets, rows, 1, 3), matrix(best, rows, 2);
    draw_uniform_actions(random, static_cast<std::size_t>(rows) * 4, uniform);
  }

  CriticLoss critic_value(double conservatism, double* gradient = nullptr) {
    std::vector<double> unused(critic.size());
    return critic_loss(critic_shape, critic.data(), batch, targets, uniform, conservatism, scratch,
                       gradient == nullptr ? unused.data() : gradient);
  }

  double actor_value(double imitation, double* gradient = nullptr) {
    std::vector<double> unused(actor.size());
    act(actor_shape, actor.data(), critic_shape, critic.data(), batch.observations, scratch);
    return actor_loss(actor_shape, actor.data(), critic_shape, critic.data(), best, imitation, scratch,
                      gradient == nullptr ? unused.data() : gradient);
  }

  /// Which units are on in the last passes.
  std::vector<bool> on() const {
    std::vector<bool> units;
    for (const auto* tape : {&scratch.actor, &scratch.critic, &scratch.wide_critic})
      for (const auto& network : tape->networks)
        for (std::size_t k = 1; k + 1 < network.values.size(); ++k)
          for (Index i = 0; i < network.values[k].size(); ++i) units.push_back(network.values[k].data()[i] > 0);
    return units;
  }
};

/// Whether the derivatives with respect to all parameters are those of finite differences; where a unit goes on or off
/// there is nothing to compare.
void expect_derivatives(OmarSpecimen& specimen, std::vector<double>& parameters, const std::vector<double>& gradient,
                        const std::function<double()>& value) {
  std::size_t compared = 0;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const double h = 1e-5;
    const double here = parameters[i];
    parameters[i] = here + h;
    const double above = value();
    const auto on = specimen.on();
    parameters[i] = here - h;
    const double below = value();
    parameters[i] = here;
    if (specimen.on() != on) continue;
    ++compared;
    const double slope = (above - below) / (2 * h);
    EXPECT_NEAR(gradient[i], slope, 1e-7 * std::max({1.0, std::abs(slope), std::abs(above)})) << i;
  }
  EXPECT_GT(compared, parameters.size() * 9 / 10);
}

TEST(CriticLoss, ItsGradientIsThatOfFiniteDifferences) {
  for (const double conservatism : {0.0, 0.7, 5.0}) {
    OmarSpecimen specimen(3);
    std::vector<double> gradient(specimen.critic.size(), 0.0);
    specimen.critic_value(conservatism, gradient.data());
    expect_derivatives(specimen, specimen.critic, gradient, [&] {
      const auto loss = specimen.critic_value(conservatism);
      return loss.error + conservatism * loss.conservative;
    });
  }
}

TEST(CriticLoss, IsTheOneWrittenDownPlainly) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    OmarSpecimen specimen(seed);
    const auto loss = specimen.critic_value(2);
    double error = 0;
    double conservative = 0;
    const auto& batch = specimen.batch;
    for (std::size_t k = 0; k < 2; ++k) {
      const auto data =
          plain_outputs(specimen.critic_shape, specimen.critic, k, joined(batch.observations, batch.actions));
      const auto held =
          plain_outputs(specimen.critic_shape, specimen.critic, k, joined(batch.observations, specimen.uniform));
      for (Index r = 0; r < data.rows(); ++r) {
        error += std::pow(data(r, 0) - specimen.targets(r, 0), 2) / 9;
        double sum = 0;
        for (Index u = 0; u < 4; ++u) sum += std::exp(held(4 * r + u, 0) - std::log(0.25));
        conservative += (std::log(sum) - data(r, 0)) / 9;
      }
    }
    EXPECT_NEAR(loss.error, error, 1e-10 * error);
    EXPECT_NEAR(loss.conservative, conservative, 1e-10 * (1 + std::abs(conservative)));
  }
}

TEST(CriticTargets, AreThoseWrittenDownPlainly) {
  OmarSpecimen specimen(5, 40);
  const auto& batch = specimen.batch;
  const auto& shape = specimen.critic_shape;
  const Matrix<double> actions =
      plain_outputs(specimen.actor_shape, specimen.target_actor, 0, batch.next_observations).array().tanh();
  const auto rows = joined(batch.next_observations, actions);
  const auto values = [&](std::size_t k) { return plain_outputs(shape, specimen.target_critic, k, rows); };
  // Now the one critic is smaller, now the other.
  specimen.target_critic[shape.network_begin(0) + shape.network().bias(2)] += (values(1) - values(0)).mean();
  const auto one = values(0);
  const auto other = values(1);
  critic_targets(specimen.actor_shape, specimen.target_actor.data(), shape, specimen.target_critic.data(), batch, 0.9,
                 specimen.scratch, specimen.targets);
  for (Index r = 0; r < 40; ++r) {
    const double value = std::min(one(r, 0), other(r, 0));
    EXPECT_NEAR(specimen.targets(r, 0), batch.rewards(r, 0) + 0.9 * (batch.dones(r, 0) == 1 ? 0 : value), 1e-12);
  }
  EXPECT_TRUE(batch.dones.sum() > 0 && batch.dones.sum() < 40);
}

TEST(ActorLoss, ItsGradientIsThatOfFiniteDifferences) {
  for (const double imitation : {0.0, 0.3, 1.0}) {
    OmarSpecimen specimen(4);
    std::vector<double> gradient(specimen.actor.size(), 0.0);
    specimen.actor_value(imitation, gradient.data());
    expect_derivatives(specimen, specimen.actor, gradient, [&] { return specimen.actor_value(imitation); });
  }
}

TEST(ActorLoss, IsTheOneWrittenDownPlainly) {
  for (const double imitation : {0.0, 0.3, 1.0}) {
    OmarSpecimen specimen(6);
    const double loss = specimen.actor_value(imitation);
    const Matrix<double> actions =
        plain_outputs(specimen.actor_shape, specimen.actor, 0, specimen.batch.observations).array().tanh();
    const double value =
        plain_outputs(specimen.critic_shape, specimen.critic, 0, joined(specimen.batch.observations, actions)).mean();
    const double wanted = imitation * (actions - specimen.best).array().square().mean() - (1 - imitation) * value +
                          1e-3 * actions.array().square().mean();
    EXPECT_NEAR(loss, wanted, 1e-12 * (1 + std::abs(wanted)));
    EXPECT_LE((specimen.scratch.actions - actions).cwiseAbs().maxCoeff(), 1e-14);
  }
}

TEST(ActorLoss, OfConservativeQLearningLooksAtNoSearch) {
  OmarSpecimen specimen(6);
  const double loss = specimen.actor_value(0);
  specimen.best.resize(0, 0);
  EXPECT_EQ(specimen.actor_value(0), loss);
}

RC_GTEST_PROP(LogSumExp, IsTheNaiveSum, ()) {
  RandomStream random({.seed = *rc::gen::arbitrary<std::uint64_t>()});
  std::vector<double> values(*rc::gen::inRange<std::size_t>(1, 20));
  for (double& value : values) value = 20 * random.uniform() - 10;
  double sum = 0;
  for (const double value : values) sum += std::exp(value);
  const double naive = std::log(sum);
  RC_ASSERT(std::abs(log_sum_exp<double>(values) - naive) <= 1e-13 * (1 + std::abs(naive)));
  for (const double shift : {-1e4, 1e4}) {  // where the naive sum is nothing or too much
    auto there = values;
    for (double& value : there) value += shift;
    RC_ASSERT(std::abs(log_sum_exp<double>(there) - shift - naive) <= 1e-10);
  }
}

TEST(UniformActions, FillTheSquare) {
  RandomStream random;
  Matrix<double> actions;
  draw_uniform_actions(random, 4000, actions);
  ASSERT_EQ(actions.rows(), 4000);
  ASSERT_EQ(actions.cols(), 2);
  EXPECT_TRUE(actions.minCoeff() >= -1 && actions.minCoeff() < -0.99);
  EXPECT_TRUE(actions.maxCoeff() < 1 && actions.maxCoeff() > 0.99);
  EXPECT_NEAR(actions.col(0).mean(), 0, 0.04);
  EXPECT_NEAR((actions.col(0).array() * actions.col(1).array()).mean(), 0, 0.025);
}

// ---- the search ------------------------------------------------------------------------------------------------

/// Values -steepness * |a - peak|^2 of any number of actions an observation; each observation has a peak.
struct Hill {
  Matrix<double> peaks;
  double steepness = 1;
  Matrix<double> values;

  double at(Index row, double x, double y) const {
    return -steepness * (std::pow(x - peaks(row, 0), 2) + std::pow(y - peaks(row, 1), 2));
  }

  ActionValues<double> of() {
    return [this](const Matrix<double>& actions) -> const Matrix<double>& {
      const Index each = actions.rows() / peaks.rows();
      values.resize(actions.rows(), 1);
      for (Index i = 0; i < values.rows(); ++i) values(i, 0) = at(i / each, actions(i, 0), actions(i, 1));
      return values;
    };
  }

  Matrix<double> of_own(const Matrix<double>& actions) const {
    Matrix<double> own(actions.rows(), 1);
    for (Index r = 0; r < own.rows(); ++r) own(r, 0) = at(r, actions(r, 0), actions(r, 1));
    return own;
  }
};

/// The search over hills from given own actions.
Matrix<double> found(Hill& hill, const Matrix<double>& own, std::uint64_t seed = 1) {
  RandomStream random({.seed = seed});
  Matrix<double> best;
  search_actions(hill.of(), own, hill.of_own(own), random, best);
  return best;
}

TEST(Search, FindsACornerExactly) {
  for (const double x : {-1, 1})
    for (const double y : {-1, 1}) {
      Hill hill{Matrix<double>(200, 2), 50, {}};
      hill.peaks.col(0).setConstant(x);
      hill.peaks.col(1).setConstant(y);
      const auto best = found(hill, Matrix<double>::Zero(200, 2));
      const auto right = ((best - hill.peaks).array().abs().rowwise().maxCoeff() == 0).count();
      EXPECT_GT(right, 170) << x << " " << y;
    }
}

TEST(Search, ComesNearAPeakInside) {
  RandomStream random;
  Hill hill{Matrix<double>(300, 2), 50, {}};
  fill(random, hill.peaks, 0.8);
  const auto best = found(hill, Matrix<double>::Constant(300, 2, -1));
  // The best of ten actions drawn about the middle is 0.4 away on average.
  EXPECT_LT((best - hill.peaks).rowwise().norm().mean(), 0.3);
}

RC_GTEST_PROP(Search, IsNeverWorseThanTheOwnAction, ()) {
  const auto seed = *rc::gen::arbitrary<std::uint64_t>();
  RandomStream random({.seed = seed});
  Hill hill{Matrix<double>(20, 2), *rc::gen::element(0.0, 0.1, 5.0, 1000.0), {}};
  fill(random, hill.peaks, 1.5);
  Matrix<double> own(20, 2);
  fill(random, own);
  own.topRows(5) = hill.peaks.topRows(5);  // nothing is better
  const auto best = found(hill, own, seed);
  const auto before = hill.of_own(own);
  const auto after = hill.of_own(best);
  for (Index r = 0; r < 20; ++r) {
    RC_ASSERT(after(r, 0) >= before(r, 0));
    if (r < 5) RC_ASSERT(best.row(r) == own.row(r));
    if (best.row(r) != own.row(r)) RC_ASSERT(best.row(r).cwiseAbs().maxCoeff() <= 1);
  }
  if (hill.steepness > 0) RC_ASSERT(after.mean() > before.mean());
}

TEST(Search, IsTheOneWrittenDownPlainly) {
  const Index rows = 6;
  RandomStream random;
  Hill hill{Matrix<double>(rows, 2), 1.3, {}};
  fill(random, hill.peaks);
  Matrix<double> own(rows, 2);
  fill(random, own);
  RandomStream draws({.seed = 9});
  std::vector<std::vector<std::array<double, 2>>> samples(static_cast<std::size_t>(rows));
  std::vector<std::array<double, 2>> mean(samples.size()), deviation(samples.size(), {2, 2});
  for (int round = 0; round < 3; ++round)
    for (std::size_t r = 0; r < samples.size(); ++r) {
      samples[r].assign(10, {});
      for (auto& sample : samples[r])
        for (std::size_t axis = 0; axis < 2; ++axis)
          sample[axis] = std::clamp(mean[r][axis] + deviation[r][axis] * draws.normal(), -1.0, 1.0);
      double weights = 0;
      std::array<double, 2> sum{};
      for (const auto& sample : samples[r]) {
        const double weight = std::exp(hill.at(index(r), sample[0], sample[1]));
        weights += weight;
        for (std::size_t axis = 0; axis < 2; ++axis) sum[axis] += weight * sample[axis];
      }
      for (std::size_t axis = 0; axis < 2; ++axis) {
        mean[r][axis] = sum[axis] / weights;
        double squares = 0;
        for (const auto& sample : samples[r]) squares += std::pow(sample[axis] - mean[r][axis], 2);
        deviation[r][axis] = std::sqrt(squares / 10);
      }
    }
  const auto best = found(hill, own, 9);
  for (std::size_t r = 0; r < samples.size(); ++r) {
    std::array<double, 2> wanted{own(index(r), 0), own(index(r), 1)};
    for (const auto& sample : samples[r])
      if (hill.at(index(r), sample[0], sample[1]) > hill.at(index(r), wanted[0], wanted[1])) wanted = sample;
    for (std::size_t axis = 0; axis < 2; ++axis)
      EXPECT_NEAR(best(index(r), index(axis)), wanted[axis], 1e-12) << r << " " << axis;
  }
}

TEST(Search, OfTheFirstCriticNormalisesAllItsActionsTogether) {
  OmarSpecimen specimen(8);
  const auto values =
      first_critic(specimen.critic_shape, specimen.critic.data(), specimen.batch.observations, specimen.scratch);
  const auto wanted =
      plain_outputs(specimen.critic_shape, specimen.critic, 0, joined(specimen.batch.observations, specimen.uniform));
  EXPECT_LE((values(specimen.uniform) - wanted).cwiseAbs().maxCoeff(), 1e-12);
}

// ---- the learner -----------------------------------------------------------------------------------------------

const test::Files& small_files() {
  static const auto files =
      test::files_of(test::played_arrays(Layout(Scenario::named("simple_tag")), test::pursuit_cast(), 1, 0, 8));
  return files;
}

/// 200 transitions.
const DataSet& omar_data() {
  static const auto data = test::parse(small_files());
  return data;
}

OmarSettings small_omar() {
  auto settings = OmarSettings::published("simple_tag", "medium");
  settings.hidden = 8;
  settings.batch = 24;
  return settings;
}

/// What a learner saves.
struct OmarState {
  struct Network {
    std::vector<float> parameters, target;
    std::uint64_t steps = 0;
    std::vector<float> first, second;
  };
  struct Predator {
    Network actor, critic;
    std::vector<float> mean, variance;
  };
  std::uint64_t steps = 0;
  std::array<Predator, 3> predators;

  static OmarState of(const OmarLearner& learner) {
    const auto bytes = saved(learner);
    const std::string source = "run";
    sct::RecordReader reader(bytes, source, learner_record);
    OmarState state;
    state.steps = reader.steps();
    for (auto& predator : state.predators) {
      for (Network* network : {&predator.actor, &predator.critic})
        *network = {reader.floats(), reader.floats(), reader.steps(), reader.floats(), reader.floats()};
      predator.mean = reader.floats();
      predator.variance = reader.floats();
    }
    EXPECT_TRUE(reader.done());
    return state;
  }

  std::string bytes() const {
    sct::RecordWriter writer(learner_record);
    writer.word(steps);
    for (const auto& predator : predators) {
      for (const Network* network : {&predator.actor, &predator.critic}) {
        writer.floats(network->parameters), writer.floats(network->target);
        writer.word(network->steps);
        writer.floats(network->first), writer.floats(network->second);
      }
      writer.floats(predator.mean), writer.floats(predator.variance);
    }
    return std::move(writer).sealed();
  }
};

/// All rows of a predator in double.
Transitions<double> all_rows(const DataSet& data, std::size_t agent) {
  const auto rows = data.transitions();
  const std::size_t inputs = data.scenario().observation_size(agent);
  Matrix<float> now(index(rows), index(inputs)), next = now, actions(index(rows), 2);
  Transitions<double> all;
  all.rewards.resize(index(rows), 1), all.dones.resize(index(rows), 1);
  for (std::size_t r = 0; r < rows; ++r) {
    data.observation(agent, r, {now.row(index(r)).data(), inputs});
    data.next_observation(agent, r, {next.row(index(r)).data(), inputs});
    data.action(agent, r, std::span<float, 2>(actions.row(index(r)).data(), 2));
    all.rewards(index(r), 0) = static_cast<double>(data.reward(agent, r));
    all.dones(index(r), 0) = data.done(agent, r) ? 1 : 0;
  }
  all.observations = now.cast<double>(), all.next_observations = next.cast<double>();
  all.actions = actions.cast<double>();
  return all;
}

TEST(OmarLearner, AStepOfAllRowsIsWhatItsLossesSay) {
  // A batch of all rows: drawn without replacement it is the data themselves, in some order. Some of them end here.
  auto arrays = test::played_arrays(Layout(Scenario::named("simple_tag")), test::pursuit_cast(), 1, 0, 8);
  for (std::size_t r = 0; r < 200; r += 3)
    for (const char* name : {"dones_0.npy", "dones_1.npy", "dones_2.npy"}) arrays[name].values[r] = 1;
  const auto files = test::files_of(arrays);
  const auto data = test::parse(files);
  auto settings = small_omar();
  settings.cql = true;
  settings.learning_rate = 0.05;  // so that targets are soon far from networks
  settings.batch = data.transitions();
  OmarLearner learner(data, settings);
  const NormalisedShape actor(MlpShape({16, 8, 8, 2}), 1);
  const NormalisedShape critic(MlpShape({18, 8, 8, 1}), 2);
  for (int i = 0; i < 5; ++i) {
    const auto before = OmarState::of(learner);
    const auto losses = learner.step();
    const auto after = OmarState::of(learner);
    ASSERT_EQ(losses.size(), 3U);
    EXPECT_EQ(losses[0].name, "critic");
    EXPECT_EQ(losses[1].name, "conservative");
    EXPECT_EQ(losses[2].name, "actor");
    double error = 0;
    double climb = 0;
    for (std::size_t agent = 0; agent < 3; ++agent) {
      const auto batch = all_rows(data, agent);
      const auto& there = before.predators[agent];
      const auto& here = after.predators[agent];
      OmarScratch<double> scratch;
      Matrix<double> targets;
      critic_targets(actor, doubles(there.actor.target).data(), critic, doubles(there.critic.target).data(), batch,
                     0.95, scratch, targets);
      const auto rows = joined(batch.observations, batch.actions);
      for (std::size_t k = 0; k < 2; ++k)
        error += (plain_outputs(critic, doubles(there.critic.parameters), k, rows) - targets).squaredNorm() / 600;
      // The actor climbs the critic that has just moved.
      const Matrix<double> actions =
          plain_outputs(actor, doubles(there.actor.parameters), 0, batch.observations).array().tanh();
      climb -=
          plain_outputs(critic, doubles(here.critic.parameters), 0, joined(batch.observations, actions)).mean() / 3;
      climb += 1e-3 * actions.array().square().mean() / 3;
      for (std::size_t p = 0; p < here.actor.target.size(); ++p)
        EXPECT_NEAR(here.actor.target[p], 0.99F * there.actor.target[p] + 0.01F * here.actor.parameters[p], 1e-6F);
      for (std::size_t p = 0; p < here.critic.target.size(); ++p)
        EXPECT_NEAR(here.critic.target[p], 0.99F * there.critic.target[p] + 0.01F * here.critic.parameters[p], 1e-6F);
      for (std::size_t c = 0; c < 16; ++c) {
        const auto column = batch.observations.col(index(c)).array();
        const double mean = column.mean();
        const double variance = (column - mean).square().sum() / 199;
        const auto remembered = [](float number, double now) { return 0.9 * static_cast<double>(number) + 0.1 * now; };
        EXPECT_NEAR(here.mean[c], remembered(there.mean[c], mean), 1e-6);
        EXPECT_NEAR(here.variance[c], remembered(there.variance[c], variance), 1e-6);
      }
    }
    EXPECT_NEAR(losses[0].value, error, 1e-5 * (1 + error)) << i;
    EXPECT_NEAR(losses[2].value, climb, 1e-5 * (1 + std::abs(climb))) << i;
    EXPECT_EQ(after.steps, before.steps + 1);
  }
}

TEST(OmarLearner, BeginsWithSmallActionsAndTargetsThatAreItsNetworks) {
  const auto state = OmarState::of(OmarLearner(omar_data(), small_omar()));
  EXPECT_EQ(state.steps, 0U);
  for (const auto& predator : state.predators) {
    EXPECT_EQ(predator.actor.target, predator.actor.parameters);
    EXPECT_EQ(predator.critic.target, predator.critic.parameters);
    EXPECT_EQ(predator.mean, std::vector<float>(16, 0.0F));
    EXPECT_EQ(predator.variance, std::vector<float>(16, 1.0F));
    const NormalisedShape actor(MlpShape({16, 8, 8, 2}), 1);
    const std::size_t last = actor.network_begin(0) + actor.network().weight(2);
    for (std::size_t i = 0; i < 16; ++i) EXPECT_LE(std::abs(predator.actor.parameters[last + i]), 3e-3F);
  }
  const auto& [first, second, third] = state.predators;
  EXPECT_NE(first.actor.parameters, second.actor.parameters);
  EXPECT_NE(second.critic.parameters, third.critic.parameters);
  const NormalisedShape critic(MlpShape({18, 8, 8, 1}), 2);
  EXPECT_NE(first.critic.parameters[critic.network_begin(0)], first.critic.parameters[critic.network_begin(1)]);
}

TEST(OmarLearner, MovesByAdamAndItsTargetsFollow) {
  auto settings = small_omar();
  settings.averaging = 0.25;
  OmarLearner learner(omar_data(), settings);
  const auto before = OmarState::of(learner);
  learner.step();
  const auto after = OmarState::of(learner);
  const auto expect_followed = [](const OmarState::Network& there, const OmarState::Network& here) {
    std::size_t moved = 0;
    EXPECT_EQ(here.steps, 1U);
    double length = 0;
    for (std::size_t i = 0; i < here.target.size(); ++i) {
      // The first step of Adam is the rate, against the gradient's sign.
      const double step = static_cast<double>(here.parameters[i]) - static_cast<double>(there.parameters[i]);
      if (std::abs(here.first[i]) > 1e-6F) {
        EXPECT_NEAR(step, here.first[i] > 0 ? -1e-2 : 1e-2, 1e-4) << i;
        ++moved;
      }
      length += std::pow(static_cast<double>(here.first[i]) / 0.1, 2);
      EXPECT_NEAR(here.target[i], 0.75F * there.target[i] + 0.25F * here.parameters[i], 1e-6F) << i;
    }
    EXPECT_GT(moved, here.target.size() / 3);
    EXPECT_LE(std::sqrt(length), 0.5 + 1e-4);  // the clip
    return std::sqrt(length);
  };
  for (std::size_t agent = 0; agent < 3; ++agent) {
    expect_followed(before.predators[agent].actor, after.predators[agent].actor);
    EXPECT_NEAR(expect_followed(before.predators[agent].critic, after.predators[agent].critic), 0.5, 1e-4);
  }
}

TEST(OmarLearner, WithoutImitationIsConservativeQLearning) {
  auto omar = small_omar();
  auto cql = omar;
  cql.cql = true;
  const auto after = [](const OmarSettings& settings) {
    OmarLearner learner(omar_data(), settings);
    for (int i = 0; i < 4; ++i) learner.step();
    return saved(learner);
  };
  const auto with = after(omar);
  omar.imitation = 0;
  EXPECT_EQ(after(omar), after(cql));
  EXPECT_NE(with, after(cql));
}

TEST(OmarLearner, WithImitationAloneGoesToWhereTheSearchGoes) {
  // Only the direction can be told: the actions come nearer to those that the critic values most.
  auto settings = small_omar();
  settings.imitation = 1;
  settings.learning_rate = 3e-3;
  OmarLearner learner(omar_data(), settings);
  double first = 0;
  double last = 0;
  for (int i = 0; i < 100; ++i) {
    const double loss = learner.step()[2].value;
    if (i < 10) first += loss;
    if (i >= 90) last += loss;
  }
  EXPECT_LT(last, 0.8 * first);
}

TEST(OmarLearner, FitsItsCritics) {
  auto settings = small_omar();
  settings.conservatism = 0.1;
  settings.learning_rate = 3e-2;
  settings.batch = 50;
  OmarLearner learner(omar_data(), settings);
  const double first = learner.step()[0].value;
  double last = 0;
  for (int i = 0; i < 80; ++i) last = learner.step()[0].value;
  EXPECT_LT(last, 0.7 * first);
}

TEST(OmarLearner, ConservatismWidensTheGapBetweenDataAndOtherActions) {
  const auto gap = [](double conservatism) {
    auto settings = small_omar();
    settings.conservatism = conservatism;
    OmarLearner learner(omar_data(), settings);
    double last = 0;
    for (int i = 0; i < 60; ++i) last = learner.step()[1].value;
    return last;
  };
  EXPECT_LT(gap(5), gap(0) - 0.25);
}

TEST(OmarLearner, GoesOnFromWhatItSavedAsIfItHadNeverStopped) {
  OmarLearner whole(omar_data(), small_omar());
  std::string middle;
  for (int i = 0; i < 6; ++i) {
    if (i == 3) middle = saved(whole);
    whole.step();
  }
  OmarLearner again(omar_data(), small_omar());
  again.step();  // what was before is gone
  load(again, middle);
  EXPECT_EQ(again.steps(), 3U);
  EXPECT_EQ(saved(again), middle);
  for (int i = 3; i < 6; ++i) again.step();
  EXPECT_EQ(saved(again), saved(whole));
  EXPECT_EQ(again.policy({}), whole.policy({}));
}

TEST(OmarLearner, RefusesNumbersOfAnotherNetworkAndStaysAsItWas) {
  OmarLearner learner(omar_data(), small_omar());
  learner.step();
  const auto before = saved(learner);
  const auto refuses = [&](const std::string& bytes, const std::string& part) {
    expect_error<InputFileError>([&] { load(learner, bytes); }, "run: " + part);
    EXPECT_EQ(saved(learner), before);
  };
  auto wider = small_omar();
  wider.hidden = 9;
  refuses(saved(OmarLearner(omar_data(), wider)), "a checkpoint of other networks");
  const auto good = OmarState::of(learner);
  const auto change = [&](const std::function<void(OmarState::Predator&)>& how, const std::string& part) {
    auto state = good;
    state.steps = 7;
    how(state.predators[2]);  // after two that fit
    refuses(state.bytes(), part);
  };
  change([](auto& p) { p.mean.pop_back(); }, "a checkpoint of other networks");
  change([](auto& p) { p.variance.push_back(1); }, "a checkpoint of other networks");
  change([](auto& p) { p.actor.target.pop_back(); }, "a checkpoint of other networks");
  change([](auto& p) { p.critic.parameters.push_back(0); }, "a checkpoint of other networks");
  change([](auto& p) { p.critic.first.clear(); }, "a checkpoint of other networks");
  change([](auto& p) { p.actor.second.clear(); }, "a checkpoint of other networks");
  change([](auto& p) { p.variance[15] = -1; }, "damaged checkpoint: a mean square below 0");
  change([](auto& p) { p.critic.second[0] = -1; }, "damaged checkpoint: a mean square below 0");
  sct::RecordWriter writer(learner_record);
  writer.word(7);
  refuses(std::move(writer).sealed(), "damaged checkpoint: ends too soon");
}

TEST(OmarLearnerThreads, ChangeNoBit) {
  const auto after = [](unsigned threads) {
    auto settings = small_omar();
    settings.threads = threads;
    OmarLearner learner(omar_data(), settings);
    for (int i = 0; i < 4; ++i) learner.step();
    return saved(learner);
  };
  const auto one = after(1);
  EXPECT_EQ(one, after(2));
  EXPECT_EQ(one, after(5));
}

TEST(OmarLearner, DependsOnItsSeed) {
  auto settings = small_omar();
  OmarLearner one(omar_data(), settings);
  settings.seed = 2;
  OmarLearner other(omar_data(), settings);
  // Even from the same numbers: the batches are others.
  load(other, saved(one));
  one.step(), other.step();
  EXPECT_NE(saved(one), saved(other));
}

TEST(OmarLearner, GivesThePolicyOfItsActorsInTheWorld) {
  OmarLearner learner(omar_data(), small_omar());
  for (int i = 0; i < 3; ++i) learner.step();
  const auto policy = parse_policy(learner.policy({{"data", "small"}}), "policy");
  EXPECT_EQ(policy.scenario, "simple_tag");
  EXPECT_EQ(policy.side, Side::predators);
  EXPECT_EQ(policy.notes, (std::map<std::string, std::string>{{"data", "small"}}));
  ASSERT_EQ(policy.networks.size(), 3U);
  const auto state = OmarState::of(learner);
  for (std::size_t agent = 0; agent < 3; ++agent) {
    const auto& network = policy.networks[agent];
    const auto& predator = state.predators[agent];
    EXPECT_EQ(network.squash, Squash::tanh);
    EXPECT_EQ(network.shape, MlpShape({16, 8, 8, 2}));
    ASSERT_TRUE(network.normalisation.has_value());
    EXPECT_EQ(network.normalisation->mean, predator.mean);
    EXPECT_EQ(network.normalisation->variance, predator.variance);
    auto numbers = network.normalisation->weight;
    numbers.insert(numbers.end(), network.normalisation->bias.begin(), network.normalisation->bias.end());
    numbers.insert(numbers.end(), network.parameters.begin(), network.parameters.end());
    EXPECT_EQ(numbers, predator.actor.parameters);
  }
}

TEST(OmarLearner, SaysWhatItsRunDependsOn) {
  auto settings = OmarSettings::published("simple_world", "medium");
  settings.hidden = 8;
  settings.batch = 24;
  EXPECT_EQ(OmarLearner(omar_data(), settings).description(),
            "learner = omar\nconservatism = 0.5\nimitation = 0.1\nhidden = 8\nlearning-rate = 0.01\nbatch = 24\n"
            "discount = 0.95\naveraging = 0.01\nclip = 0.5\nseed = 1\n");
  settings.cql = true;
  settings.threads = 2;
  EXPECT_EQ(OmarLearner(omar_data(), settings).description(),
            "learner = cql\nconservatism = 0.5\nhidden = 8\nlearning-rate = 0.01\nbatch = 24\ndiscount = 0.95\n"
            "averaging = 0.01\nclip = 0.5\nseed = 1\n");
}

TEST(OmarSettings, AreThePublishedOnesOfScenarioAndLevel) {
  struct Row {
    const char* scenario;
    const char* level;
    double imitation;
    double conservatism;
    std::uint64_t steps;
  };
  for (const Row& row :
       {Row{"simple_tag", "random", 0.9, 0.5, 2001}, Row{"simple_tag", "medium-replay", 0.9, 0.5, 1001},
        Row{"simple_tag", "medium", 0.7, 5, 2001}, Row{"simple_tag", "expert", 0.9, 5, 2001},
        Row{"simple_world", "random", 1, 0.5, 1001}, Row{"simple_world", "medium-replay", 0.7, 1, 1001},
        Row{"simple_world", "medium", 0.1, 0.5, 1001}, Row{"simple_world", "expert", 0.9, 5, 1001}}) {
    const auto settings = OmarSettings::published(row.scenario, row.level);
    EXPECT_EQ(settings.imitation, row.imitation);
    EXPECT_EQ(settings.conservatism, row.conservatism);
    EXPECT_FALSE(settings.cql);
    EXPECT_TRUE(OmarSettings::published(row.scenario, row.level, true).cql);
    EXPECT_EQ(published_omar_steps(row.scenario, row.level), row.steps);
    EXPECT_EQ(settings.discount, 0.95);
    EXPECT_EQ(settings.batch, 1024U);
  }
  expect_error<UsageError>([] { OmarSettings::published("simple_tag", "best"); }, "level 'best'");
  expect_error<UsageError>([] { OmarSettings::published("simple_spread", "expert"); }, "simple_spread");
  expect_error<UsageError>([] { published_omar_steps("simple_tag", ""); }, "level ''");
}

TEST(OmarSettings, MustBeInRange) {
  const auto refuses = [](const std::function<void(OmarSettings&)>& change, const std::string& part) {
    auto settings = small_omar();
    change(settings);
    expect_error<UsageError>([&] { OmarLearner(omar_data(), settings); }, part);
  };
  refuses([](auto& s) { s.conservatism = -1; }, "conservatism -1");
  refuses([](auto& s) { s.imitation = 1.5; }, "imitation 1.5");
  refuses([](auto& s) { s.imitation = NAN; }, "imitation nan");
  refuses([](auto& s) { s.hidden = 0; }, "hidden 0");
  refuses([](auto& s) { s.learning_rate = 0; }, "learning-rate 0");
  refuses([](auto& s) { s.batch = 1; }, "batch 1: expected");
  refuses([](auto& s) { s.discount = 1; }, "discount 1");
  refuses([](auto& s) { s.averaging = 0; }, "averaging 0");
  refuses([](auto& s) { s.clip = 0; }, "clip 0");
  refuses([](auto& s) { s.batch = 201; }, "batch 201: set has 200 transitions");
}

}  // namespace
}  // namespace folk::mpe
