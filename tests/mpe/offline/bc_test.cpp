// Behaviour cloning: its gradient against finite differences, its step against the definition written down plainly.

#include <folk/mpe/data/observation_scale.h>
#include <folk/mpe/offline/bc.h>
#include <folk/mpe/world/random_stream.h>
#include <folk/sct/network/dropout.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
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

// ---- the loss ----------------------------------------------------------------------------------------------------

/// By its definition: one number after the other.
template <class S>
double naive_loss(const MlpShape& shape, const std::vector<S>& parameters, const BcExamples<S>& examples) {
  double sum = 0;
  for (Index row = 0; row < examples.windows.rows(); ++row) {
    std::vector<double> values(examples.windows.row(row).begin(), examples.windows.row(row).end());
    for (std::size_t layer = 0; layer < shape.layers(); ++layer) {
      std::vector<double> next(shape.widths()[layer + 1]);
      for (std::size_t unit = 0; unit < next.size(); ++unit) {
        next[unit] = static_cast<double>(parameters[shape.bias(layer) + unit]);
        for (std::size_t k = 0; k < values.size(); ++k)
          next[unit] += static_cast<double>(parameters[shape.weight(layer) + unit * values.size() + k]) * values[k];
        if (layer + 1 < shape.layers())
          next[unit] = std::max(next[unit], 0.0) * static_cast<double>(examples.dropout[layer](row, index(unit)));
      }
      values = next;
    }
    for (std::size_t k = 0; k < values.size(); ++k)
      sum += std::pow(std::tanh(values[k]) - static_cast<double>(examples.actions(row, index(k))), 2);
  }
  return sum / static_cast<double>(examples.actions.size());
}

void fill(RandomStream& random, Matrix<double>& numbers, Index rows, std::size_t columns) {
  numbers.resize(rows, index(columns));
  for (Index i = 0; i < numbers.size(); ++i) numbers.data()[i] = uniform(random, -1, 1);
}

/// Windows with any number of zeros, dropout of a third of the hidden units.
BcExamples<double> some_examples(const MlpShape& shape, Index rows, RandomStream& random) {
  BcExamples<double> examples;
  fill(random, examples.windows, rows, shape.inputs());
  fill(random, examples.actions, rows, shape.outputs());
  for (Index row = 0; row < rows; ++row)
    examples.padding.push_back(static_cast<Index>(random() % static_cast<std::uint64_t>(shape.inputs() + 1)));
  std::sort(examples.padding.begin(), examples.padding.end());
  for (Index row = 0; row < rows; ++row)
    examples.windows.row(row).head(examples.padding[static_cast<std::size_t>(row)]).setZero();
  for (std::size_t layer = 0; layer + 1 < shape.layers(); ++layer) {
    examples.dropout.emplace_back(rows, index(shape.widths()[layer + 1]));
    for (double& factor : examples.dropout.back().reshaped()) factor = random.chance(1 / 3.0) ? 0 : 1.5;
  }
  return examples;
}

TEST(BcLoss, ItsGradientIsThatOfFiniteDifferences) {
  Workers workers(1);
  RandomStream random({.seed = 5});
  for (const std::vector<std::size_t>& widths :
       {std::vector<std::size_t>{23, 6}, {40, 9, 6}, {37, 11, 8, 6}, {3, 5, 4, 7, 2}}) {
    const MlpShape shape(widths);
    const auto examples = some_examples(shape, 7, random);
    std::vector<double> parameters(shape.parameters());
    for (double& number : parameters) number = uniform(random, -0.5, 0.5);
    BcTape<double> tape;
    std::vector<double> gradient(parameters.size(), 1e9);  // what was there does not count
    const double loss = bc_loss(shape, parameters.data(), examples, tape, gradient.data(), workers);
    EXPECT_NEAR(loss, naive_loss(shape, parameters, examples), 1e-14);
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      const double here = parameters[i];
      const double h = 1e-5;
      parameters[i] = here + h;
      const double above = naive_loss(shape, parameters, examples);
      parameters[i] = here - h;
      const double below = naive_loss(shape, parameters, examples);
      parameters[i] = here;
      ASSERT_NEAR(gradient[i], (above - below) / (2 * h), 1e-8) << "parameter " << i << " of " << shape.parameters();
    }
  }
}

TEST(BcLoss, IsTheSameOnAnyNumberOfThreads) {
  RandomStream random({.seed = 6});
  const MlpShape shape({300, 70, 33, 6});
  const auto wide = some_examples(shape, 19, random);
  BcExamples<float> examples{wide.windows.cast<float>(),
                             wide.padding,
                             wide.actions.cast<float>(),
                             {wide.dropout[0].cast<float>(), wide.dropout[1].cast<float>()}};
  const auto parameters = initial_parameters(shape, 1, 1);
  std::vector<std::vector<float>> gradients;
  std::vector<double> losses;
  for (const unsigned threads : {1U, 2U, 3U, 80U}) {
    Workers workers(threads);
    BcTape<float> tape;
    gradients.emplace_back(parameters.size());
    losses.push_back(bc_loss(shape, parameters.data(), examples, tape, gradients.back().data(), workers));
    EXPECT_EQ(gradients.back(), gradients.front()) << threads;
    EXPECT_EQ(losses.back(), losses.front()) << threads;
  }
}

// ---- the learner -------------------------------------------------------------------------------------------------

struct Played {
  explicit Played(const std::string& scenario = "simple_tag", std::size_t episodes = 9)
      : files(test::files_of(
            test::played_arrays(Layout(Scenario::named(scenario)), test::pursuit_cast(), 3, 0, episodes))),
        data(test::parse(files)) {}

  test::Files files;
  DataSet data;
};

BcSettings small_bc() {
  BcSettings settings;
  settings.context = 4;
  settings.hidden = 10;
  settings.batch = 16;
  settings.learning_rate = 1e-2;
  settings.warmup_steps = 0;
  return settings;
}

double step(BcLearner& learner) {
  const auto losses = learner.step();
  EXPECT_EQ(losses.size(), 1U);
  EXPECT_EQ(losses.at(0).name, "action");
  return losses.at(0).value;
}

/// The window that ends with step `last` of an episode, and what the predators did then.
void put_example(const DataSet& data, std::size_t context, std::size_t episode, std::size_t last,
                 BcExamples<float>& examples, Index row) {
  const auto scale = measured_scale(data);
  Index column = 0;
  for (std::size_t back = context; back-- > 0;)
    for (std::size_t predator = 0; predator < 3; ++predator) {
      std::vector<float> numbers(data.scenario().observation_size(predator));
      if (back <= last) {
        data.observation(predator, episode * 25 + last - back, numbers);
        scale.apply(predator, numbers);
      }
      for (const float number : numbers) examples.windows(row, column++) = number;
    }
  for (std::size_t number = 0; number < 6; ++number)
    examples.actions(row, index(number)) =
        data.table(DataField::action, number / 2).at(episode * 25 + last, number % 2);
}

/// What step `number` of a learner learns from.
BcExamples<float> drawn_examples(const DataSet& data, const BcSettings& settings, std::uint64_t number) {
  BcExamples<float> examples;
  const Index rows = index(settings.batch);
  std::vector<std::pair<std::size_t, std::size_t>> endings;
  RandomStream random = random_stream(settings.seed, RandomUse::offline_batch, number);
  for (Index row = 0; row < rows; ++row) {
    const auto episode = static_cast<std::size_t>(random() % data.episodes());
    endings.emplace_back(episode, static_cast<std::size_t>(random() % 25));
  }
  std::stable_sort(endings.begin(), endings.end(), [](auto a, auto b) { return a.second > b.second; });
  examples.windows.resize(rows, index(settings.context * team_observation_size(data.scenario())));
  examples.actions.resize(rows, 6);
  for (Index row = 0; row < rows; ++row) {
    const auto [episode, last] = endings[static_cast<std::size_t>(row)];
    put_example(data, settings.context, episode, last, examples, row);
  }
  const sct::Dropout dropout(settings.dropout, settings.seed, number);
  for (std::size_t layer = 0; layer < settings.layers; ++layer) {
    examples.dropout.push_back(Matrix<float>(rows, index(settings.hidden)));
    for (Index row = 0; row < rows; ++row) {
      std::vector<std::uint8_t> keep(settings.hidden);
      dropout.keep(keep.data(), keep.size(), static_cast<std::size_t>(row), layer);
      for (std::size_t unit = 0; unit < keep.size(); ++unit)
        examples.dropout.back()(row, index(unit)) = keep[unit] != 0 ? static_cast<float>(dropout.scale()) : 0.0F;
    }
  }
  return examples;
}

TEST(BcLearner, ItsLossIsTheOneWrittenDownPlainly) {
  for (const char* scenario : {"simple_tag", "simple_world"})
    for (const std::size_t context : {3, 30})
      for (const double dropout : {0.0, 0.4}) {
        const Played played(scenario);
        BcSettings settings = small_bc();
        settings.context = context;
        settings.dropout = dropout;
        BcLearner learner(played.data, settings);
        EXPECT_EQ(learner.shape(), MlpShape({context * 3 * played.data.scenario().observation_size(0), 10, 10, 10, 6}));
        for (std::uint64_t number = 0; number < 3; ++number) {
          const double plain =
              naive_loss(learner.shape(), learner.parameters(), drawn_examples(played.data, settings, number));
          EXPECT_EQ(learner.steps(), number);
          EXPECT_NEAR(step(learner), plain, 1e-6) << scenario << " " << context << " " << dropout;
        }
      }
}

TEST(BcLearner, AStepIsOneOfAdamW) {
  const Played played;
  const auto moves = [&](const std::function<void(BcSettings&)>& change) {
    BcSettings settings = small_bc();
    settings.weight_decay = 0;
    change(settings);
    BcLearner learner(played.data, settings);
    const auto before = learner.parameters();
    step(learner);
    double most = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
      const double kept = static_cast<double>(before[i]) * (1 - settings.learning_rate * settings.weight_decay);
      most = std::max(most, std::abs(static_cast<double>(learner.parameters()[i]) - kept));
    }
    return most;  // Adam's first step is as long as the rate
  };
  EXPECT_NEAR(moves([](BcSettings&) {}), 1e-2, 1e-5);
  EXPECT_NEAR(moves([](BcSettings& s) { s.learning_rate = 1e-3; }), 1e-3, 1e-6);
  EXPECT_NEAR(moves([](BcSettings& s) { s.weight_decay = 1; }), 1e-2, 1e-5);
  EXPECT_NEAR(moves([](BcSettings& s) { s.warmup_steps = 4; }), 2.5e-3, 1e-5);
  EXPECT_LT(moves([](BcSettings& s) { s.clip = 1e-9; }), 2e-3);  // then the gradient is below Adam's epsilon
}

TEST(BcLearner, ItsRateFallsToNothing) {
  const Played played;
  BcSettings settings = small_bc();
  settings.decay_steps = 3;
  BcLearner learner(played.data, settings);
  std::vector<std::vector<float>> parameters;
  for (int i = 0; i < 5; ++i) {
    step(learner);
    parameters.push_back(learner.parameters());
  }
  EXPECT_NE(parameters[1], parameters[2]);
  EXPECT_EQ(parameters[2], parameters[3]);
  EXPECT_EQ(parameters[2], parameters[4]);
}

TEST(BcLearner, LearnsWhatTheLastObservationTells) {
  const Played played("simple_tag", 40);
  BcSettings settings = small_bc();
  settings.context = 2;
  settings.hidden = 32;
  BcLearner learner(played.data, settings);
  double first = 0;
  double last = 0;
  for (int i = 0; i < 400; ++i) {
    const double loss = step(learner);
    if (i < 10) first += loss / 10;
    if (i >= 390) last += loss / 10;
  }
  EXPECT_LT(last, 0.2 * first);
}

TEST(BcLearner, ItsBitsAreTheSameOnAnyNumberOfThreads) {
  const Played played;
  BcSettings settings = small_bc();
  BcLearner one(played.data, settings);
  settings.threads = 3;
  BcLearner three(played.data, settings);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(step(one), step(three));
  EXPECT_EQ(one.parameters(), three.parameters());
  EXPECT_EQ(one.description(), three.description());
}

TEST(BcLearner, SeedsTellRunsApart) {
  const Played played;
  BcSettings settings = small_bc();
  BcLearner one(played.data, settings);
  settings.seed = 2;
  BcLearner two(played.data, settings);
  EXPECT_NE(one.parameters(), two.parameters());
  EXPECT_NE(one.description(), two.description());
}

// ---- what is kept of a run ---------------------------------------------------------------------------------------

TEST(BcLearner, GoesOnAsIfItHadNeverStopped) {
  const Played played;
  BcSettings settings = small_bc();
  settings.warmup_steps = 5;
  settings.decay_steps = 20;
  BcLearner whole(played.data, settings);
  for (int i = 0; i < 4; ++i) step(whole);
  const std::string middle = saved(whole);
  BcLearner resumed(played.data, settings);
  step(resumed);  // a step of its own leaves no trace
  load(resumed, middle);
  EXPECT_EQ(resumed.steps(), 4U);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(step(resumed), step(whole));
  EXPECT_EQ(saved(resumed), saved(whole));
  EXPECT_EQ(resumed.policy({}), whole.policy({}));
}

TEST(BcLearner, RefusesNumbersOfAnotherNetworkAndStaysAsItWas) {
  const Played played;
  BcLearner learner(played.data, small_bc());
  step(learner);
  const std::string before = saved(learner);
  BcSettings settings = small_bc();
  settings.hidden = 11;
  BcLearner other(played.data, settings);
  step(other);
  expect_error<InputFileError>([&] { load(learner, saved(other)); }, "run: a checkpoint of another network; resume");
  EXPECT_EQ(saved(learner), before);
  // Parameters that fit, and moments that do not.
  for (const int wrong : {0, 1, 2}) {
    sct::RecordWriter writer(learner_record);
    const std::vector<float> fit(learner.parameters().size());
    const std::vector<float> unfit(fit.size() - 1);
    writer.floats(wrong == 0 ? unfit : fit);
    writer.word(7);
    writer.floats(wrong == 1 ? unfit : fit);
    writer.floats(wrong == 2 ? unfit : fit);
    expect_error<InputFileError>([&] { load(learner, std::move(writer).sealed()); }, "run: a checkpoint of another");
    EXPECT_EQ(saved(learner), before);
  }
  sct::RecordWriter writer(learner_record);
  writer.floats(learner.parameters());
  writer.word(7);
  expect_error<InputFileError>([&] { load(learner, std::move(writer).sealed()); }, "run: damaged checkpoint");
  EXPECT_EQ(saved(learner), before);
}

TEST(BcLearner, ItsPolicyIsWhatItLearnt) {
  const Played played("simple_world");
  BcLearner learner(played.data, small_bc());
  step(learner);
  const auto policy = parse_window_policy(learner.policy({{"algorithm", "bc"}}), "policy");
  EXPECT_EQ(policy.scenario, "simple_world");
  EXPECT_EQ(policy.context, 4U);
  EXPECT_EQ(policy.scale, measured_scale(played.data));
  EXPECT_EQ(policy.shape, learner.shape());
  EXPECT_EQ(policy.parameters, learner.parameters());
  EXPECT_EQ(policy.notes, (std::map<std::string, std::string>{{"algorithm", "bc"}}));
}

/// Puts an episode of the data before a team, step by step, and holds what it does against the network applied to what
/// training would have drawn for that row.
void expect_play_as_trained(const DataSet& data, const BcSettings& settings, const BcLearner& learner,
                            std::size_t episode) {
  const Layout layout(data.scenario());
  const auto controller = window_controller("bc", parse_window_policy(learner.policy({}), "policy"), data.scenario());
  const Team team = controller.team(layout, Side::predators);
  Batch batch(data.scenario(), 1);
  const Block block = batch.block(0);
  for (std::size_t agent = 0; agent < 3; ++agent) team[agent]->start(layout, block, agent, {});
  for (std::size_t step = 0; step < 25; ++step) {
    for (std::size_t agent = 0; agent < 3; ++agent) {
      std::vector<float> numbers(data.scenario().observation_size(agent));
      data.observation(agent, episode * 25 + step, numbers);
      for (std::size_t k = 0; k < numbers.size(); ++k)
        block.observations[(layout.observation_begin(agent) + k) * block_lanes] = static_cast<double>(numbers[k]);
    }
    BcExamples<float> examples;
    examples.windows.resize(1, index(learner.shape().inputs()));
    examples.actions.resize(1, 6);
    put_example(data, settings.context, episode, step, examples, 0);
    for (std::size_t layer = 0; layer < settings.layers; ++layer)
      examples.dropout.push_back(Matrix<float>::Ones(1, index(settings.hidden)));
    for (std::size_t agent = 0; agent < 3; ++agent) {
      team[agent]->act(layout, block, agent, {.step = step});
      const auto [x, y] = action_rows(block, agent);
      examples.actions(0, index(2 * agent)) = static_cast<float>(*x);
      examples.actions(0, index(2 * agent + 1)) = static_cast<float>(*y);
    }
    // The mean square of the differences.
    EXPECT_LT(naive_loss(learner.shape(), learner.parameters(), examples), 1e-12) << "step " << step;
  }
}

TEST(BcLearner, ItsPolicySeesWhatTrainingSaw) {
  for (const char* scenario : {"simple_tag", "simple_world"}) {
    const Played played(scenario);
    BcSettings settings = small_bc();
    settings.context = 7;
    BcLearner learner(played.data, settings);
    for (int i = 0; i < 50; ++i) step(learner);
    expect_play_as_trained(played.data, settings, learner, 4);
  }
}

TEST(BcSettings, AreRefusedOutOfRange) {
  const auto refused = [](const std::function<void(BcSettings&)>& change, const std::string& part) {
    BcSettings settings;
    require_sound(settings);
    change(settings);
    expect_error<UsageError>([&] { require_sound(settings); }, part);
    expect_error<UsageError>([&] { BcLearner(Played("simple_tag", 1).data, settings); }, part);
  };
  refused([](BcSettings& s) { s.context = 0; }, "context 0: expected a whole number from 1 to 50");
  refused([](BcSettings& s) { s.context = 51; }, "context 51");
  refused([](BcSettings& s) { s.hidden = 0; }, "hidden 0");
  refused([](BcSettings& s) { s.layers = 0; }, "layers 0");
  refused([](BcSettings& s) { s.layers = 16; }, "layers 16");
  refused([](BcSettings& s) { s.dropout = 1; }, "dropout 1: expected a number from 0 to 0.99");
  refused([](BcSettings& s) { s.batch = 0; }, "batch 0");
  refused([](BcSettings& s) { s.learning_rate = 0; }, "learning-rate 0");
  refused([](BcSettings& s) { s.learning_rate = NAN; }, "learning-rate nan");
  refused([](BcSettings& s) { s.weight_decay = -1; }, "weight-decay -1");
  refused([](BcSettings& s) { s.clip = 0; }, "clip 0");
  refused([](BcSettings& s) { s.threads = 0; }, "threads 0");
}

}  // namespace
}  // namespace folk::mpe
