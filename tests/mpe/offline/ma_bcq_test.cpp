// MA-BCQ against its definition, written down plainly in double, and what every offline learner must keep to.

#include <folk/mpe/offline/ma_bcq.h>
#include <folk/mpe/world/random_stream.h>
#include <folk/sct/files/record_bytes.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "games/expect_error.h"
#include "mpe/data/small_data_set.h"
#include "mpe/offline/plain_network.h"
#include "mpe/offline/saved_learner.h"

namespace folk::mpe {
namespace {

using folk::test::expect_error;
using test::as_double;
using test::joined;
using test::learner_record;
using test::load;
using test::plain_mix;
using test::plain_network;
using test::row_of;
using test::saved;

void fill(RandomStream& random, double* numbers, std::size_t count, double size) {
  for (std::size_t i = 0; i < count; ++i) numbers[i] = size * (2 * random.uniform() - 1);
}

Matrix<double> any_matrix(RandomStream& random, Index rows, Index columns) {
  Matrix<double> matrix(rows, columns);
  fill(random, matrix.data(), static_cast<std::size_t>(matrix.size()), 1);
  return matrix;
}

std::vector<double> any_parameters(RandomStream& random, std::size_t count) {
  std::vector<double> parameters(count);
  fill(random, parameters.data(), count, 0.7);
  return parameters;
}

// ---- losses ------------------------------------------------------------------------------------------------------

TEST(MixedCriticsLoss, GradientIsThatOfFiniteDifferences) {
  RandomStream random({.seed = 3});
  const Index rows = 5;
  const MlpShape critic({5, 6, 4, 1});
  const MixerShape mixer(9, 6);
  std::vector<std::vector<double>> critics;
  for (int i = 0; i < 6; ++i) critics.push_back(any_parameters(random, critic.parameters()));
  auto mixing = any_parameters(random, mixer.parameters());
  std::vector<Matrix<double>> inputs;
  for (int i = 0; i < 3; ++i) inputs.push_back(any_matrix(random, rows, 5));
  const auto states = any_matrix(random, rows, 9);
  const auto wanted = any_matrix(random, rows, 1);

  MixedCritics<double> networks{critic, {}, mixer, mixing.data()};
  for (const auto& parameters : critics) networks.critics.push_back(parameters.data());
  MixedCriticsTape<double> tape;
  tape.mixer.layer.prepare(mixer.layer(), states);
  Workers workers(1);
  const double loss = mixed_critics_loss(networks, inputs, wanted, tape, workers);

  const auto plain = [&] {
    double sum = 0;
    for (std::size_t r = 0; r < static_cast<std::size_t>(rows); ++r) {
      std::vector<double> values;
      for (std::size_t i = 0; i < 6; ++i)
        values.push_back(plain_network(critic, critics[i].data(), row_of(inputs[i / 2], r))[0]);
      sum += std::pow(plain_mix(mixer.layer(), mixing.data(), row_of(states, r), values) - wanted(index(r), 0), 2);
    }
    return sum / static_cast<double>(rows);
  };
  EXPECT_NEAR(loss, plain(), 1e-8);
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t k = 0; k < critics[i].size(); ++k)
      EXPECT_NEAR(tape.critic_gradients[i][k], test::difference(critics[i][k], plain), 1e-7) << i << ' ' << k;
  for (std::size_t k = 0; k < mixing.size(); k += 7)
    EXPECT_NEAR(tape.mixing_gradient[k], test::difference(mixing[k], plain), 1e-7) << k;
}

TEST(PerturbationLoss, GradientIsThatOfFiniteDifferences) {
  RandomStream random({.seed = 5});
  const std::size_t rows = 40;
  const double most = 0.7;  // so that some actions are cut
  const MlpShape decoder({3 + 4, 6, 2});
  const MlpShape perturbation({3 + 2, 6, 5, 2});
  const MlpShape critic({3 + 2, 6, 4, 1});
  const auto decoding = any_parameters(random, decoder.parameters());
  auto perturbing = any_parameters(random, perturbation.parameters());
  const std::array critics{any_parameters(random, critic.parameters()), any_parameters(random, critic.parameters())};
  const Matrix<double> weights = any_matrix(random, rows, 2).cwiseAbs();
  const Matrix<double> input = any_matrix(random, rows, 7) * 2;

  PerturbationTape<double> tape;
  tape.candidates.decoder.prepare(decoder, rows);
  tape.candidates.decoder.input() = input;
  propose<double>({decoder, decoding.data()}, {perturbation, perturbing.data()}, most, tape.candidates);
  std::vector<double> gradient(perturbing.size(), 7.0);  // it is added to what is there
  const double loss = perturbation_loss<double>({perturbation, perturbing.data()}, most, critic,
                                                {critics[0].data(), critics[1].data()}, weights, tape, gradient.data());

  int cut = 0;
  const auto plain = [&] {
    double sum = 0;
    for (std::size_t r = 0; r < rows; ++r) {
      auto observation = row_of(tape.candidates.decoder.input(), r);
      auto action = plain_network(decoder, decoding.data(), observation);
      observation.resize(3);
      for (double& number : action) number = std::tanh(number);
      const auto shift = plain_network(perturbation, perturbing.data(), joined(observation, action));
      for (std::size_t c = 0; c < 2; ++c) {
        action[c] += most * std::tanh(shift[c]);
        cut += std::abs(action[c]) > 1 ? 1 : 0;
        action[c] = std::clamp(action[c], -1.0, 1.0);
      }
      for (std::size_t k = 0; k < 2; ++k)
        sum -= weights(index(r), index(k)) * plain_network(critic, critics[k].data(), joined(observation, action))[0];
    }
    return sum / static_cast<double>(rows);
  };
  EXPECT_NEAR(loss, plain(), 1e-12);
  EXPECT_GT(cut, 3);
  EXPECT_LT(cut, 60);
  for (std::size_t i = 0; i < gradient.size(); ++i)
    EXPECT_NEAR(gradient[i] - 7, test::difference(perturbing[i], plain), 1e-7) << i;
}

TEST(ChooseCandidates, TakesThatOfTheHighestWeightedTwins) {
  Matrix<double> one(6, 1);
  Matrix<double> other(6, 1);
  one << 1, 5, 2, -3, -4, -9;
  other << 1, -4, 2, -3, -1, 9;
  const std::array<const Matrix<double>*, 2> values{&one, &other};
  const auto chosen = [&](double lambda) {
    Matrix<double> all = Matrix<double>::Zero(4, 4);
    choose_candidates(values, 3, lambda, 1, 2, all);
    return all;
  };
  Matrix<double> wanted = Matrix<double>::Zero(4, 4);
  wanted.block(1, 2, 2, 2) << 2, 2, -3, -3;  // by 1, -1.75, 2 and -3, -3.25, -4.5
  EXPECT_EQ(chosen(0.75), wanted);
  wanted.block(1, 2, 2, 2) << 5, -4, -9, 9;
  EXPECT_EQ(chosen(0), wanted);
}

// ---- a step ------------------------------------------------------------------------------------------------------

MaBcqSettings small_ma_bcq() {
  MaBcqSettings settings;
  settings.vae_hidden = 9;
  settings.hidden = {8, 7};
  settings.batch = 31;
  settings.candidates = 3;
  settings.acting_candidates = 5;
  settings.learning_rate = 0.01;
  settings.averaging = 0.1;
  settings.perturbation = 0.3;
  settings.seed = 7;
  return settings;
}

/// The files of a few episodes, and their data set.
struct FewEpisodes {
  explicit FewEpisodes(const char* scenario = "simple_tag")
      : layout(Scenario::named(scenario)),
        files(test::files_of(test::played_arrays(layout, test::pursuit_cast(), 3, 0, 4))),
        data(test::parse(files)) {}

  Layout layout;
  test::Files files;
  DataSet data;
};

/// The losses of a learner's next step in double, as BASELINES has them.
struct Plain {
  const DataSet& data;
  const MaBcqSettings& settings;
  std::uint64_t step;
  std::size_t observed = data.scenario().observation_size(0);
  ActionVaeShape vae{observed, settings.vae_hidden};
  MlpShape perturbation{{observed + 2, settings.hidden[0], settings.hidden[1], 2}};
  MlpShape critic{{observed + 2, settings.hidden[0], settings.hidden[1], 1}};
  MixerShape mixer{3 * observed, 6};
  std::vector<std::size_t> rows = drawn_rows();

  std::vector<std::size_t> drawn_rows() const {
    RandomStream random = random_stream(settings.seed, RandomUse::offline_batch, step);
    std::vector<std::size_t> drawn;
    for (std::size_t i = 0; i < settings.batch; ++i)
      drawn.push_back(static_cast<std::size_t>(random() % data.transitions()));
    return drawn;
  }

  std::vector<double> observation(std::size_t agent, std::size_t row, bool next) const {
    std::vector<float> numbers(observed);
    if (next)
      data.next_observation(agent, row, numbers);
    else
      data.observation(agent, row, numbers);
    return as_double(numbers);
  }
  std::vector<double> action(std::size_t agent, std::size_t row) const {
    std::array<float, 2> numbers{};
    data.action(agent, row, numbers);
    return {static_cast<double>(numbers[0]), static_cast<double>(numbers[1])};
  }
  std::vector<double> state(std::size_t row, bool next) const {
    std::vector<double> numbers;
    for (std::size_t agent = 0; agent < 3; ++agent) numbers = joined(numbers, observation(agent, row, next));
    return numbers;
  }

  /// A candidate action.
  std::vector<double> candidate(const std::vector<double>& own, const std::vector<double>& vae_parameters,
                                const std::vector<double>& perturbing, RandomStream& random) const {
    std::vector<double> latent;
    for (int k = 0; k < 4; ++k) latent.push_back(std::clamp(random.normal(), -0.5, 0.5));
    auto chosen = plain_network(vae.decoder(), vae_parameters.data() + vae.decoder_begin(), joined(own, latent));
    for (double& number : chosen) number = std::tanh(number);
    const auto shift = plain_network(perturbation, perturbing.data(), joined(own, chosen));
    for (std::size_t c = 0; c < 2; ++c)
      chosen[c] = std::clamp(chosen[c] + settings.perturbation * std::tanh(shift[c]), -1.0, 1.0);
    return chosen;
  }

  double vae_loss(std::size_t agent, const std::vector<double>& parameters) const {
    double errors = 0;
    double divergences = 0;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const auto own = observation(agent, rows[r], false);
      const auto done = action(agent, rows[r]);
      RandomStream random = random_stream(settings.seed, RandomUse::latent, step, r, agent);
      const auto code = plain_network(vae.encoder(), parameters.data(), joined(own, done));
      std::vector<double> latent;
      for (std::size_t k = 0; k < 4; ++k) {
        const double log = std::clamp(code[4 + k], -4.0, 15.0);
        latent.push_back(code[k] + std::exp(log) * random.normal());
        divergences -= 0.5 * (1 + 2 * log - code[k] * code[k] - std::exp(2 * log));
      }
      const auto decoded = plain_network(vae.decoder(), parameters.data() + vae.decoder_begin(), joined(own, latent));
      for (std::size_t c = 0; c < 2; ++c) errors += std::pow(std::tanh(decoded[c]) - done[c], 2);
    }
    const double count = static_cast<double>(rows.size());
    return errors / (2 * count) + 0.5 * divergences / (4 * count);
  }

  /// r + discount * Q_tot' of each example.
  std::vector<double> wanted(const std::vector<BcqAgent>& before, const LearningNetwork& mixing,
                             const std::vector<BcqAgent>& after) const {
    std::vector<double> numbers;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      std::vector<double> values;
      for (std::size_t agent = 0; agent < 3; ++agent) {
        const auto own = observation(agent, rows[r], true);
        const auto decoding = as_double(after[agent].vae.parameters);  // the autoencoder has moved already
        const auto perturbing = as_double(before[agent].perturbation.target);
        RandomStream random = random_stream(settings.seed, RandomUse::candidates, step, r, agent);
        double best = -std::numeric_limits<double>::infinity();
        std::array<double, 2> twins{};
        for (std::size_t i = 0; i < settings.candidates; ++i) {
          const auto input = joined(own, candidate(own, decoding, perturbing, random));
          std::array<double, 2> here{};
          for (std::size_t k = 0; k < 2; ++k)
            here[k] = plain_network(critic, as_double(before[agent].critics[k].target).data(), input)[0];
          const double value =
              settings.lambda * std::min(here[0], here[1]) + (1 - settings.lambda) * std::max(here[0], here[1]);
          if (value > best) best = value, twins = here;
        }
        values.insert(values.end(), twins.begin(), twins.end());
      }
      const double next = plain_mix(mixer.layer(), as_double(mixing.target).data(), state(rows[r], true), values);
      numbers.push_back(static_cast<double>(data.reward(0, rows[r])) + settings.discount * next);
    }
    return numbers;
  }

  /// `critics` [agent * 2 + twin].
  double critic_loss(const std::vector<std::vector<double>>& critics, const std::vector<double>& mixing,
                     const std::vector<double>& aims) const {
    double errors = 0;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      std::vector<double> values;
      for (std::size_t i = 0; i < 6; ++i)
        values.push_back(plain_network(critic, critics[i].data(),
                                       joined(observation(i / 2, rows[r], false), action(i / 2, rows[r])))[0]);
      errors += std::pow(plain_mix(mixer.layer(), mixing.data(), state(rows[r], false), values) - aims[r], 2);
    }
    return errors / static_cast<double>(rows.size());
  }

  double actor_loss(const std::vector<std::vector<double>>& perturbing, const std::vector<BcqAgent>& after,
                    const LearningNetwork& mixing) const {
    double sum = 0;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      std::vector<double> values;
      for (std::size_t agent = 0; agent < 3; ++agent) {
        const auto own = observation(agent, rows[r], false);
        RandomStream random = random_stream(settings.seed, RandomUse::candidates, step, settings.batch + r, agent);
        const auto input =
            joined(own, candidate(own, as_double(after[agent].vae.parameters), perturbing[agent], random));
        for (const auto& twin : after[agent].critics)
          values.push_back(plain_network(critic, as_double(twin.parameters).data(), input)[0]);
      }
      sum -= plain_mix(mixer.layer(), as_double(mixing.parameters).data(), state(rows[r], false), values);
    }
    return sum / static_cast<double>(rows.size());
  }
};

std::vector<std::vector<double>> perturbations(const std::vector<BcqAgent>& agents) {
  std::vector<std::vector<double>> all;
  for (const auto& agent : agents) all.push_back(as_double(agent.perturbation.parameters));
  return all;
}

std::vector<std::vector<double>> critics(const std::vector<BcqAgent>& agents) {
  std::vector<std::vector<double>> all;
  for (const auto& agent : agents)
    for (const auto& critic : agent.critics) all.push_back(as_double(critic.parameters));
  return all;
}

// After some steps, when targets are no longer the same as what they follow.
TEST(MaBcq, StepMeasuresTheLossesOfItsDefinition) {
  const FewEpisodes small;
  const auto settings = small_ma_bcq();
  MaBcqLearner learner(small.data, settings);
  for (int i = 0; i < 4; ++i) learner.step();
  const auto before = learner.agents();
  const auto mixer = learner.mixer();
  const auto losses = learner.step();
  ASSERT_EQ(losses.size(), 3U);
  EXPECT_EQ(losses[0].name, "vae");
  EXPECT_EQ(losses[1].name, "critic");
  EXPECT_EQ(losses[2].name, "actor");
  const Plain plain{small.data, settings, 4};
  double vae = 0;
  for (std::size_t agent = 0; agent < 3; ++agent) vae += plain.vae_loss(agent, as_double(before[agent].vae.parameters));
  EXPECT_NEAR(losses[0].value, vae / 3, 1e-6 * vae);
  const auto aims = plain.wanted(before, mixer, learner.agents());
  const double critic = plain.critic_loss(critics(before), as_double(mixer.parameters), aims);
  EXPECT_NEAR(losses[1].value, critic, 1e-5 * critic);
  EXPECT_NEAR(losses[2].value, plain.actor_loss(perturbations(before), learner.agents(), learner.mixer()), 1e-5);
}

/// Adam's first step is as long as the learning rate, against the sign of the gradient.
void expect_descent(const std::vector<float>& before, const std::vector<float>& after, std::vector<double>& parameters,
                    const std::function<double()>& loss, double rate) {
  int compared = 0;
  const std::size_t every = std::max<std::size_t>(1, parameters.size() / 11);
  for (std::size_t i = 0; i < parameters.size(); i += every) {
    const double slope = test::difference(parameters[i], loss, 1e-5);
    if (std::abs(slope) < 1e-4) continue;
    const double moved = static_cast<double>(after[i]) - static_cast<double>(before[i]);
    EXPECT_NEAR(moved, slope > 0 ? -rate : rate, 1e-3 * rate) << i;
    ++compared;
  }
  EXPECT_GT(compared, 2);
}

TEST(MaBcq, FirstStepDescendsAllLosses) {
  const FewEpisodes small;
  auto settings = small_ma_bcq();
  settings.perturbation = 2;  // so that actors matter
  MaBcqLearner learner(small.data, settings);
  const auto before = learner.agents();
  const auto mixer = learner.mixer();
  learner.step();
  const auto& after = learner.agents();
  const Plain plain{small.data, settings, 0};
  const auto aims = plain.wanted(before, mixer, after);
  for (const std::size_t agent : {0, 2}) {
    auto vae = as_double(before[agent].vae.parameters);
    expect_descent(
        before[agent].vae.parameters, after[agent].vae.parameters, vae, [&] { return plain.vae_loss(agent, vae); },
        settings.learning_rate);
    auto actors = perturbations(before);
    expect_descent(
        before[agent].perturbation.parameters, after[agent].perturbation.parameters, actors[agent],
        [&] { return plain.actor_loss(actors, after, learner.mixer()); }, settings.learning_rate);
    const std::size_t twin = agent / 2;
    auto judges = critics(before);
    expect_descent(
        before[agent].critics[twin].parameters, after[agent].critics[twin].parameters, judges[2 * agent + twin],
        [&] { return plain.critic_loss(judges, as_double(mixer.parameters), aims); }, settings.learning_rate);
  }
  auto mixing = as_double(mixer.parameters);
  expect_descent(
      mixer.parameters, learner.mixer().parameters, mixing,
      [&] { return plain.critic_loss(critics(before), mixing, aims); }, settings.learning_rate);
}

void expect_followed(const LearningNetwork& before, const LearningNetwork& after, double tau) {
  ASSERT_EQ(after.target.size(), after.parameters.size());
  for (std::size_t i = 0; i < after.target.size(); ++i)
    EXPECT_NEAR(static_cast<double>(after.target[i]),
                (1 - tau) * static_cast<double>(before.target[i]) + tau * static_cast<double>(after.parameters[i]),
                1e-6);
}

TEST(MaBcq, TargetsFollow) {
  const FewEpisodes small;
  MaBcqLearner learner(small.data, small_ma_bcq());
  learner.step();
  const auto before = learner.agents();
  const auto mixer = learner.mixer();
  learner.step();
  for (std::size_t agent = 0; agent < 3; ++agent) {
    expect_followed(before[agent].perturbation, learner.agents()[agent].perturbation, 0.1);
    for (std::size_t k = 0; k < 2; ++k)
      expect_followed(before[agent].critics[k], learner.agents()[agent].critics[k], 0.1);
  }
  expect_followed(mixer, learner.mixer(), 0.1);
}

TEST(MaBcq, NoTwoNetworksBeginTheSame) {
  const FewEpisodes small("simple_world");
  const MaBcqLearner learner(small.data, small_ma_bcq());
  const ActionVaeShape vae(24, 9);
  std::set<float> first;
  for (const auto& agent : learner.agents()) {
    first.insert(agent.vae.parameters[0]);
    first.insert(agent.vae.parameters[vae.decoder_begin()] * std::sqrt(28.0F / 26.0F));  // a layer of two inputs more
    first.insert(agent.perturbation.parameters[0]);
    for (const auto& critic : agent.critics) first.insert(critic.parameters[0]);
  }
  EXPECT_EQ(first.size(), 15U);
  EXPECT_EQ(learner.agents()[0].critics[0].target, learner.agents()[0].critics[0].parameters);
}

// ---- runs --------------------------------------------------------------------------------------------------------

TEST(MaBcq, GoesOnAsIfItHadNeverStopped) {
  const FewEpisodes small;
  MaBcqLearner whole(small.data, small_ma_bcq());
  MaBcqLearner first(small.data, small_ma_bcq());
  for (int i = 0; i < 3; ++i) first.step();
  MaBcqLearner second(small.data, small_ma_bcq());
  second.step();
  load(second, saved(first));
  EXPECT_EQ(second.steps(), 3U);
  EXPECT_EQ(saved(second), saved(first));
  for (int i = 0; i < 2; ++i) second.step();
  for (int i = 0; i < 5; ++i) whole.step();
  EXPECT_EQ(saved(second), saved(whole));
  EXPECT_EQ(second.policy({}), whole.policy({}));
  EXPECT_NE(saved(first), saved(whole));
}

TEST(MaBcqThreads, ChangeNoBit) {
  const FewEpisodes small("simple_world");
  std::vector<std::string> runs;
  for (const unsigned threads : {1U, 2U, 3U, 5U}) {
    auto settings = small_ma_bcq();
    settings.threads = threads;
    settings.candidates = 40;  // several pieces a batch
    MaBcqLearner learner(small.data, settings);
    for (int i = 0; i < 3; ++i) learner.step();
    runs.push_back(saved(learner) + learner.description());
  }
  for (const auto& run : runs) EXPECT_EQ(run, runs[0]);
}

TEST(MaBcq, DependsOnItsSeed) {
  const FewEpisodes small;
  auto settings = small_ma_bcq();
  MaBcqLearner one(small.data, settings);
  ++settings.seed;
  MaBcqLearner other(small.data, settings);
  EXPECT_NE(saved(one), saved(other));
}

/// Expects a load to be refused, and nothing to have changed.
void expect_no_load(const std::string& bytes, const std::string& part) {
  const FewEpisodes small;
  MaBcqLearner learner(small.data, small_ma_bcq());
  learner.step();
  const auto before = saved(learner);
  const std::string source = "run";
  sct::RecordReader reader(bytes, source, learner_record);
  expect_error<InputFileError>([&] { learner.load(reader); }, part);
  EXPECT_EQ(saved(learner), before);
  EXPECT_EQ(learner.steps(), 1U);
}

TEST(MaBcq, RefusesCheckpointsOfOtherNetworks) {
  const FewEpisodes small;
  const FewEpisodes world("simple_world");
  const std::string part = "run: a checkpoint of other networks";
  const auto changed = [&](const std::function<void(MaBcqSettings&)>& change) {
    auto settings = small_ma_bcq();
    change(settings);
    return saved(MaBcqLearner(small.data, settings));
  };
  expect_no_load(changed([](MaBcqSettings& s) { s.vae_hidden = 10; }), part);
  expect_no_load(changed([](MaBcqSettings& s) { s.hidden[0] = 9; }), part);
  expect_no_load(changed([](MaBcqSettings& s) { s.hidden[1] = 9; }), part);
  expect_no_load(saved(MaBcqLearner(world.data, small_ma_bcq())), part);
}

/// A checkpoint by hand: `change` is made to its last network, the mixer.
std::string checkpoint(const std::function<void(LearningNetwork&)>& change) {
  const FewEpisodes small;
  const MaBcqLearner learner(small.data, small_ma_bcq());
  sct::RecordWriter writer(learner_record);
  const auto put = [&](const LearningNetwork& network) {
    writer.floats(network.parameters);
    writer.floats(network.target);
    writer.word(network.optimiser.steps);
    writer.floats(network.optimiser.first);
    writer.floats(network.optimiser.second);
  };
  writer.word(2);
  for (const auto& agent : learner.agents())
    for (const auto& network : {agent.vae, agent.perturbation, agent.critics[0], agent.critics[1]}) put(network);
  auto mixer = learner.mixer();
  change(mixer);
  put(mixer);
  return std::move(writer).sealed();
}

TEST(MaBcq, RefusesCheckpointsWhoseLastNetworkIsWrong) {
  const FewEpisodes small;
  MaBcqLearner learner(small.data, small_ma_bcq());
  load(learner, checkpoint([](LearningNetwork&) {}));
  EXPECT_EQ(learner.steps(), 2U);
  const std::string other = "run: a checkpoint of other networks";
  expect_no_load(checkpoint([](LearningNetwork& mixer) { mixer.parameters.pop_back(); }), other);
  expect_no_load(checkpoint([](LearningNetwork& mixer) { mixer.target.clear(); }), other);
  expect_no_load(checkpoint([](LearningNetwork& mixer) { mixer.optimiser.first.push_back(0); }), other);
  expect_no_load(checkpoint([](LearningNetwork& mixer) { mixer.optimiser.second.pop_back(); }), other);
  expect_no_load(checkpoint([](LearningNetwork& mixer) { mixer.optimiser.second.back() = -1; }), "below 0");
}

TEST(MaBcq, GivesThePolicyThatItHasLearned) {
  const FewEpisodes small;
  auto settings = small_ma_bcq();
  settings.perturbation = 0.1;
  MaBcqLearner learner(small.data, settings);
  learner.step();
  const auto policy = parse_bcq_policy(learner.policy({{"run", "a test"}}), "policy");
  EXPECT_EQ(policy.scenario, "simple_tag");
  EXPECT_EQ(policy.candidates, 5U);
  EXPECT_EQ(policy.perturbation, 0.1);
  EXPECT_EQ(policy.notes, (std::map<std::string, std::string>{{"run", "a test"}}));
  ASSERT_EQ(policy.networks.size(), 3U);
  const ActionVaeShape vae(16, settings.vae_hidden);
  for (std::size_t agent = 0; agent < 3; ++agent) {
    const auto& own = learner.agents()[agent];
    EXPECT_EQ(policy.networks[agent].decoder.shape, vae.decoder());
    EXPECT_EQ(policy.networks[agent].decoder.parameters,
              std::vector<float>(own.vae.parameters.begin() + static_cast<std::ptrdiff_t>(vae.decoder_begin()),
                                 own.vae.parameters.end()));
    EXPECT_EQ(policy.networks[agent].perturbation.parameters, own.perturbation.parameters);
    EXPECT_EQ(policy.networks[agent].critic.parameters, own.critics[0].parameters);
  }
}

TEST(MaBcq, DescribesAllThatItDependsOn) {
  const FewEpisodes small;
  const auto text = [&](const MaBcqSettings& settings) { return MaBcqLearner(small.data, settings).description(); };
  const auto settings = small_ma_bcq();
  EXPECT_EQ(text(settings),
            "algorithm = ma-bcq\nscenario = simple_tag\nvae-hidden = 9\nhidden = 8 7\nlearning-rate = 0.01\n"
            "discount = 0.99\naveraging = 0.1\nbatch = 31\ncandidates = 3\nacting-candidates = 5\nperturbation = 0.3\n"
            "lambda = 0.75\nseed = 7\n");
}

TEST(MaBcqSettings, OutOfRangeAreRefused) {
  const auto refuse = [](const std::function<void(MaBcqSettings&)>& change, const std::string& part) {
    MaBcqSettings settings;
    require_sound(settings);
    change(settings);
    expect_error<UsageError>([&] { require_sound(settings); }, part);
  };
  refuse([](MaBcqSettings& s) { s.vae_hidden = 0; }, "vae-hidden 0");
  refuse([](MaBcqSettings& s) { s.hidden[1] = 5000; }, "hidden 5000");
  refuse([](MaBcqSettings& s) { s.learning_rate = NAN; }, "learning-rate nan");
  refuse([](MaBcqSettings& s) { s.discount = 1; }, "discount 1");
  refuse([](MaBcqSettings& s) { s.averaging = 0; }, "averaging 0");
  refuse([](MaBcqSettings& s) { s.batch = 0; }, "batch 0");
  refuse([](MaBcqSettings& s) { s.candidates = 0; }, "candidates 0");
  refuse([](MaBcqSettings& s) { s.acting_candidates = 10'001; }, "acting-candidates 10001");
  refuse([](MaBcqSettings& s) { s.perturbation = -0.1; }, "perturbation -0.1");
  refuse([](MaBcqSettings& s) { s.lambda = 1.5; }, "lambda 1.5");
  const FewEpisodes small;
  auto settings = small_ma_bcq();
  settings.batch = 0;
  expect_error<UsageError>([&] { MaBcqLearner(small.data, settings); }, "batch 0");
}

}  // namespace
}  // namespace folk::mpe
