// The transformers as offline learners: what a step does, and that a run can be stopped and gone on with.

#include <folk/mpe/data/observation_scale.h>
#include <folk/mpe/offline/transformer.h>
#include <folk/mpe/offline/transformer_windows.h>
#include <folk/sct/network/initial_parameters.h>
#include <folk/sct/training/self_confirming_loss.h>

#include <gtest/gtest.h>

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

const DataSet& episodes_of_tag() {
  static const test::Files files =
      test::files_of(test::played_arrays(Layout(Scenario::named("simple_tag")), test::pursuit_cast(), 3, 0, 8));
  static const DataSet data = test::parse(files);
  return data;
}

TransformerSettings small_transformer() {
  TransformerSettings settings;
  settings.hidden = 16;
  settings.layers = 1;
  settings.context = 5;
  settings.batch = 20;
  settings.optimiser.learning_rate = 3e-3;
  settings.optimiser.warmup_steps = 10;
  return settings;
}

TransformerSettings with(sct::LossMode mode) {
  auto settings = small_transformer();
  settings.mode = mode;
  return settings;
}

/// What a learner keeps.
struct TransformerState {
  std::uint64_t steps = 0;
  std::vector<float> parameters, first, second;

  static TransformerState of(const TransformerLearner& learner) { return parse(saved(learner)); }
  static TransformerState parse(const std::string& bytes) {
    static const std::string source = "run";
    sct::RecordReader reader(bytes, source, learner_record);
    TransformerState state;
    state.steps = reader.steps();
    for (auto* numbers : {&state.parameters, &state.first, &state.second}) *numbers = reader.floats();
    EXPECT_TRUE(reader.done());
    return state;
  }
  std::string bytes() const {
    sct::RecordWriter writer(learner_record);
    writer.word(steps);
    for (const auto* numbers : {&parameters, &first, &second}) writer.floats(*numbers);
    return std::move(writer).sealed();
  }
};

// ---- what is learnt ----------------------------------------------------------------------------------------------

TEST(TransformerLearner, TakesTheStepOfItsLossOnTheWindowsItDraws) {
  for (const auto mode : {sct::LossMode::teacher, sct::LossMode::selfconf, sct::LossMode::composite}) {
    auto settings = with(mode);
    settings.dropout = 0;
    TransformerLearner learner(episodes_of_tag(), settings);
    const auto& network = learner.network();
    auto parameters = sct::initial_parameters(network.architecture(), settings.seed);
    EXPECT_EQ(TransformerState::of(learner).parameters, parameters);
    sct::AdamWState<float> optimiser;
    const auto scale = measured_scale(episodes_of_tag());
    for (std::uint64_t step = 0; step < 3; ++step) {
      const auto batch = draw_windows(episodes_of_tag(), scale, settings.return_scale, settings.batch, settings.context,
                                      settings.seed, step);
      sct::SelfConfirmingLoss<float> loss(network, mode);
      std::vector<float> gradient(parameters.size());
      const auto expected = loss(parameters.data(), {batch, 0, 0, batch.window_rounds}, sct::Denominators<float>(batch),
                                 {sct::Dropout(), sct::Dropout()}, gradient.data());
      const std::pair<std::size_t, std::size_t> everything{0, parameters.size()};
      sct::adamw_step<float>(settings.optimiser, std::span(&everything, 1), gradient, optimiser, parameters);
      const auto losses = learner.step();
      ASSERT_EQ(losses.size(), 2U);
      EXPECT_EQ(losses[0].name, "belief");
      EXPECT_EQ(losses[1].name, "action");
      EXPECT_NEAR(losses[0].value, expected.belief, 1e-5);
      EXPECT_NEAR(losses[1].value, expected.action, 1e-5);
      EXPECT_EQ(learner.steps(), step + 1);
      const auto state = TransformerState::of(learner);
      for (std::size_t i = 0; i < parameters.size(); ++i) {
        ASSERT_NEAR(state.first[i], optimiser.first[i], 1e-5) << i;
        if (step > 0 || std::abs(gradient[i]) < 1e-3F) continue;  // Adam's step is of its sign alone
        ASSERT_NEAR(state.parameters[i], parameters[i], 1e-5) << i;
      }
      parameters = state.parameters;
    }
  }
}

TEST(TransformerLearner, LearnsInAHundredSteps) {
  for (const auto mode : {sct::LossMode::teacher, sct::LossMode::selfconf, sct::LossMode::action_only}) {
    auto settings = mode == sct::LossMode::action_only ? madt(small_transformer()) : with(mode);
    TransformerLearner learner(episodes_of_tag(), settings);
    std::array<double, 2> first{}, last{};
    for (int i = 0; i < 100; ++i) {
      const auto losses = learner.step();
      for (std::size_t k = 0; k < 2; ++k) {
        if (i < 10) first[k] += losses[k].value;
        if (i >= 90) last[k] += losses[k].value;
      }
    }
    EXPECT_LT(last[1], 0.7 * first[1]) << to_string(mode);
    if (mode == sct::LossMode::action_only)
      EXPECT_EQ(first[0] + last[0], 0);
    else
      EXPECT_LT(last[0], 0.9 * first[0]) << to_string(mode);
  }
}

TEST(TransformerLearner, LeavesAloneWhatItsLossDoesNotAsk) {
  TransformerLearner learner(episodes_of_tag(), madt(small_transformer()));
  const auto before = TransformerState::of(learner).parameters;
  for (int i = 0; i < 3; ++i) learner.step();
  const auto after = TransformerState::of(learner).parameters;
  for (const auto& tensor : learner.network().layout().tensors()) {
    const auto begin = static_cast<std::ptrdiff_t>(tensor.offset);
    const auto end = begin + static_cast<std::ptrdiff_t>(tensor.size());
    EXPECT_EQ(std::equal(before.begin() + begin, before.begin() + end, after.begin() + begin),
              tensor.name.starts_with("predict_opoact") || tensor.name.starts_with("embed_opoact"))
        << tensor.name;
  }
}

TEST(TransformerLearner, DropsOutOtherUnitsInEveryStep) {
  // There is one window alone: all that can differ is what is dropped.
  const auto files =
      test::files_of(test::played_arrays(Layout(Scenario::named("simple_tag")), test::pursuit_cast(), 3, 0, 1));
  const DataSet data = test::parse(files);
  const auto belief = [&](double dropout, std::uint64_t step) {
    auto settings = small_transformer();
    settings.dropout = dropout;
    settings.context = 25;
    settings.batch = 1;
    TransformerLearner learner(data, settings);
    auto state = TransformerState::of(learner);
    state.steps = step;
    load(learner, state.bytes());
    return learner.step()[0].value;
  };
  EXPECT_EQ(belief(0, 0), belief(0, 4));
  EXPECT_NE(belief(0.1, 0), belief(0.1, 4));
  EXPECT_EQ(belief(0.1, 4), belief(0.1, 4));
  EXPECT_NE(belief(0.1, 0), belief(0, 0));
  EXPECT_NE(belief(0.1, 0), belief(0.3, 0));
}

TEST(TransformerLearner, DependsOnItsSeed) {
  auto settings = small_transformer();
  settings.dropout = 0;
  TransformerLearner one(episodes_of_tag(), settings);
  settings.seed = 2;
  TransformerLearner other(episodes_of_tag(), settings);
  EXPECT_NE(TransformerState::of(one).parameters, TransformerState::of(other).parameters);
  load(other, saved(one));  // even from the same numbers: the windows are others
  one.step(), other.step();
  EXPECT_NE(saved(one), saved(other));
}

TEST(TransformerLearner, HasTheLossOfItsMode) {
  const auto after = [](sct::LossMode mode) {
    auto settings = with(mode);
    settings.dropout = 0;
    TransformerLearner learner(episodes_of_tag(), settings);
    const auto losses = learner.step();
    return std::pair(losses[0].value, losses[1].value);
  };
  const auto teacher = after(sct::LossMode::teacher);
  const auto selfconf = after(sct::LossMode::selfconf);
  EXPECT_NEAR(teacher.first, selfconf.first, 1e-6);  // both form beliefs on the truth
  EXPECT_GT(std::abs(teacher.second - selfconf.second), 1e-4);
  EXPECT_EQ(after(sct::LossMode::composite), selfconf);  // only the gradient is another
}

// ---- going on ----------------------------------------------------------------------------------------------------

TEST(TransformerLearner, GoesOnFromWhatItSavedAsIfItHadNeverStopped) {
  for (const auto mode : {sct::LossMode::teacher, sct::LossMode::selfconf}) {
    TransformerLearner whole(episodes_of_tag(), with(mode));
    std::string middle;
    for (int i = 0; i < 6; ++i) {
      if (i == 3) middle = saved(whole);
      whole.step();
    }
    TransformerLearner again(episodes_of_tag(), with(mode));
    again.step();  // what was before is gone
    load(again, middle);
    EXPECT_EQ(again.steps(), 3U);
    EXPECT_EQ(saved(again), middle);
    for (int i = 3; i < 6; ++i) again.step();
    EXPECT_EQ(saved(again), saved(whole));
    EXPECT_EQ(again.policy({}), whole.policy({}));
  }
}

TEST(TransformerLearnerThreads, ChangeNoBit) {
  for (const auto mode : {sct::LossMode::teacher, sct::LossMode::selfconf}) {
    const auto after = [&](unsigned threads) {
      auto settings = with(mode);
      settings.threads = threads;
      TransformerLearner learner(episodes_of_tag(), settings);
      for (int i = 0; i < 4; ++i) learner.step();
      return saved(learner);
    };
    const auto one = after(1);
    EXPECT_EQ(after(2), one);
    EXPECT_EQ(after(3), one);
  }
}

TEST(TransformerLearner, RefusesNumbersOfAnotherNetworkAndStaysAsItWas) {
  TransformerLearner learner(episodes_of_tag(), small_transformer());
  learner.step();
  const auto before = saved(learner);
  const auto refuses = [&](const std::string& bytes, const std::string& part) {
    expect_error<InputFileError>([&] { load(learner, bytes); }, "run: damaged checkpoint: " + part);
    EXPECT_EQ(saved(learner), before);
    EXPECT_EQ(learner.steps(), 1U);
  };
  auto wider = small_transformer();
  wider.hidden = 17;
  refuses(saved(TransformerLearner(episodes_of_tag(), wider)), "a network of another size");
  const auto change = [&](const std::function<void(TransformerState&)>& how, const std::string& part) {
    auto state = TransformerState::parse(before);
    state.steps = 7;
    how(state);
    refuses(state.bytes(), part);
  };
  change([](TransformerState& s) { s.parameters.pop_back(); }, "a network of another size");
  change([](TransformerState& s) { s.first.push_back(0); }, "a network of another size");
  change([](TransformerState& s) { s.second.clear(); }, "a network of another size");
  change([](TransformerState& s) { s.second.back() = -1; }, "a mean square below 0");
  sct::RecordWriter writer(learner_record);
  writer.word(7);
  refuses(std::move(writer).sealed(), "ends too soon");
}

// ---- settings ----------------------------------------------------------------------------------------------------

TEST(TransformerSettings, AreThoseOfThePublishedProgram) {
  const TransformerSettings settings;
  EXPECT_EQ(settings.hidden, 128U);
  EXPECT_EQ(settings.layers, 3U);
  EXPECT_EQ(settings.heads, 1U);
  EXPECT_EQ(settings.context, 20U);
  EXPECT_EQ(settings.batch, 64U);
  EXPECT_EQ(settings.dropout, 0.1);
  EXPECT_EQ(settings.return_scale, 100);
  EXPECT_EQ(settings.readout, sct::Readout::cat);
  EXPECT_EQ(settings.mode, sct::LossMode::teacher);
  EXPECT_TRUE(settings.belief_token);
  const auto& optimiser = settings.optimiser;
  EXPECT_EQ(optimiser.learning_rate, 1e-4);
  EXPECT_EQ(optimiser.weight_decay, 1e-4);
  EXPECT_EQ(optimiser.beta_1, 0.9);
  EXPECT_EQ(optimiser.beta_2, 0.999);
  EXPECT_EQ(optimiser.epsilon, 1e-8);
  EXPECT_EQ(optimiser.clip, 0.25);
  EXPECT_EQ(optimiser.warmup_steps, 10'000U);
  EXPECT_EQ(optimiser.decay_steps, 0U);
}

/// As large as the published network.
TEST(TransformerLearner, HasAsManyParametersAsThePublishedNetwork) {
  const TransformerLearner learner(episodes_of_tag(), {});
  auto architecture = learner.network().architecture();
  EXPECT_EQ(architecture.time_rows, 26U);
  EXPECT_EQ(architecture.round_tokens(), 8U);
  EXPECT_FALSE(architecture.auxiliary);
  architecture.auxiliary = true;
  EXPECT_EQ(sct::ParameterLayout(architecture).size(), 639'129U);
  TransformerSettings settings;
  settings.readout = sct::Readout::token;
  EXPECT_EQ(TransformerLearner(episodes_of_tag(), settings).network().layout().size(), 603'400U);
}

TEST(TransformerLearner, IsMadtAndRmadtByTheirSettings) {
  const auto of = [](const TransformerSettings& settings) {
    return TransformerLearner(episodes_of_tag(), settings).trained();
  };
  auto base = small_transformer();
  base.mode = sct::LossMode::selfconf;
  base.seed = 9;
  const auto without = of(madt(base));
  EXPECT_EQ(without.mode, sct::LossMode::action_only);
  EXPECT_EQ(without.architecture.readout, sct::Readout::own);
  EXPECT_FALSE(without.architecture.belief_token);
  EXPECT_EQ(without.architecture.round_tokens(), 7U);
  const auto blind = of(rmadt(base));
  EXPECT_EQ(blind.mode, sct::LossMode::teacher);
  EXPECT_EQ(blind.architecture.readout, sct::Readout::own);
  EXPECT_TRUE(blind.architecture.belief_token);
  const auto sct = of(base);
  EXPECT_EQ(sct.mode, sct::LossMode::selfconf);
  EXPECT_EQ(sct.architecture.readout, sct::Readout::cat);
  EXPECT_TRUE(sct.architecture.belief_token);
  for (const auto& policy : {without, blind, sct}) {
    EXPECT_EQ(policy.architecture.hidden, 16U);
    EXPECT_EQ(policy.architecture.layers, 1U);
    EXPECT_EQ(policy.architecture.context, 5U);
    EXPECT_EQ(policy.architecture, particle_architecture(episodes_of_tag().scenario(), policy.architecture));
  }
  EXPECT_EQ(madt(base).seed, 9U);
  EXPECT_EQ(rmadt(base).optimiser.learning_rate, 3e-3);
}

TEST(TransformerLearner, GivesThePolicyThatItIs) {
  auto settings = small_transformer();
  settings.mode = sct::LossMode::selfconf;
  settings.return_scale = 50;
  TransformerLearner learner(episodes_of_tag(), settings);
  learner.step();
  const auto policy = parse_transformer_policy(learner.policy({{"data", "small"}}), "policy");
  EXPECT_EQ(policy.scenario, "simple_tag");
  EXPECT_EQ(policy.mode, sct::LossMode::selfconf);
  EXPECT_EQ(policy.architecture, learner.network().architecture());
  EXPECT_EQ(policy.parameters, TransformerState::of(learner).parameters);
  EXPECT_EQ(policy.scale, measured_scale(episodes_of_tag()));
  EXPECT_EQ(policy.return_scale, 50);
  EXPECT_EQ(policy.notes, (std::map<std::string, std::string>{{"data", "small"}}));
  double sum = 0;
  for (std::size_t row = 0; row < 200; ++row) sum += static_cast<double>(episodes_of_tag().reward(0, row));
  EXPECT_DOUBLE_EQ(policy.return_target, sum / 8);
}

TEST(TransformerLearner, SaysWhatItsRunDependsOn) {
  auto settings = small_transformer();
  settings.threads = 2;  // on which it does not
  EXPECT_EQ(TransformerLearner(episodes_of_tag(), settings).description(),
            "loss = teacher\nreadout = cat\nbelief-token = true\nhidden = 16\nlayers = 1\nheads = 1\ncontext = 5\n"
            "batch = 20\ndropout = 0.1\nreturn-scale = 100\nlearning-rate = 0.003\nweight-decay = 0.0001\nclip = 0.25\n"
            "warmup = 10\ndecay-steps = 0\nseed = 1\n");
}

TEST(TransformerSettings, MustBeInRange) {
  const auto refuses = [](const std::function<void(TransformerSettings&)>& change, const std::string& part) {
    auto settings = small_transformer();
    change(settings);
    expect_error<UsageError>([&] { TransformerLearner(episodes_of_tag(), settings); }, part);
  };
  refuses([](auto& s) { s.batch = 0; }, "batch 0");
  refuses([](auto& s) { s.batch = 65'537; }, "batch 65537");
  refuses([](auto& s) { s.dropout = 1; }, "dropout 1");
  refuses([](auto& s) { s.dropout = NAN; }, "dropout nan");
  refuses([](auto& s) { s.dropout = -0.1; }, "dropout -0.1");
  refuses([](auto& s) { s.return_scale = 0; }, "return-scale 0");
  refuses([](auto& s) { s.optimiser.learning_rate = 0; }, "learning-rate 0");
  refuses([](auto& s) { s.optimiser.learning_rate = INFINITY; }, "learning-rate inf");
  refuses([](auto& s) { s.optimiser.weight_decay = -1; }, "weight-decay -1");
  refuses([](auto& s) { s.optimiser.clip = 0; }, "clip 0");
  refuses([](auto& s) { s.hidden = 0; }, "hidden = 0");
  refuses([](auto& s) { s.layers = 0; }, "layers = 0");
  refuses([](auto& s) { s.context = 0; }, "context = 0");
  refuses([](auto& s) { s.heads = 3; }, "heads = 3");
  refuses([](auto& s) { s.belief_token = false; }, "readout cat reads the belief token");
}

}  // namespace
}  // namespace folk::mpe
