// Outputs, losses, gradients and optimiser steps of an independent program: every file reference/sct/sct_tiny_*.json.

#include <folk/sct/training/adamw.h>
#include <folk/sct/training/batch_gradient.h>
#include <folk/sct/training/self_confirming_loss.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace folk::sct {
namespace {

using Json = nlohmann::json;
constexpr double tolerance = 1e-9;

std::vector<std::filesystem::path> golden_files() {
  const char* folder = std::getenv("FOLK_REFERENCE");
  const std::filesystem::path root = folder != nullptr ? folder : FOLK_SOURCE_DIR "/../shared/reference";
  std::vector<std::filesystem::path> files;
  for (const auto& where : {root / "sct", std::filesystem::path(FOLK_SOURCE_DIR "/tests/data/sct")})
    if (std::filesystem::is_directory(where))
      for (const auto& entry : std::filesystem::directory_iterator(where))
        if (entry.path().filename().string().starts_with("sct_tiny_") && entry.path().extension() == ".json")
          files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

void flatten(const Json& value, std::vector<double>& out) {
  if (value.is_array())
    for (const auto& part : value) flatten(part, out);
  else if (!value.is_boolean())
    out.push_back(value.get<double>());
  else
    out.push_back(value.get<bool>() ? 1 : 0);
}

std::vector<double> numbers(const Json& tensor) {
  std::vector<double> out;
  flatten(tensor.is_object() ? tensor.at("data") : tensor, out);
  return out;
}

/// The same numbers, a row a step of the batch, only steps that are no padding.
std::vector<double> unpadded(const Json& tensor, const std::vector<double>& mask) {
  const auto all = numbers(tensor);
  const std::size_t width = all.size() / mask.size();
  std::vector<double> out;
  for (std::size_t t = 0; t < mask.size(); ++t)
    if (mask[t] != 0)
      for (std::size_t i = 0; i < width; ++i) out.push_back(all[t * width + i]);
  return out;
}

struct Golden {
  explicit Golden(const std::filesystem::path& file) {
    std::ifstream in(file);
    json = Json::parse(in);
    const auto& config = json.at("config");
    architecture.hidden = config.at("hidden");
    architecture.layers = config.at("n_layer");
    architecture.heads = config.at("n_head");
    architecture.context = config.at("context");
    architecture.time_rows = config.at("max_ep_len");
    architecture.observation_size = config.at("obs_dim");
    architecture.action_size = config.at("act_dim");
    architecture.agents = config.at("n_agents");
    architecture.discrete = config.at("discrete");
    architecture.belief_token = config.value("opp_token", true);
    architecture.auxiliary = config.value("aux", false);
    const std::string variant = config.at("variant");
    architecture.readout = variant == "token" ? Readout::token
                           : variant == "cat" ? Readout::cat
                           : variant == "add" ? Readout::add
                                              : Readout::own;
    const auto& inputs = json.at("inputs");
    mask = numbers(inputs.at("mask"));
    const std::size_t windows = config.at("batch");
    const std::size_t context = mask.size() / windows;
    for (std::size_t w = 0; w < windows; ++w) {
      std::size_t length = 0;
      for (std::size_t t = 0; t < context; ++t) length += mask[w * context + t] != 0 ? 1U : 0U;
      batch.window_rounds.push_back(length);
    }
    batch.returns = unpadded(inputs.at("R"), mask);
    batch.observations = unpadded(inputs.at("obs"), mask);
    for (const double t : unpadded(inputs.at("ts"), mask)) batch.timesteps.push_back(static_cast<int>(t));
    actions(inputs.at("opp"), batch.opponent);
    actions(inputs.at("cur"), batch.own);
    if (!architecture.auxiliary) return;
    batch.next_observations = unpadded(inputs.at("next_obs"), mask);
    batch.next_returns = unpadded(inputs.at("next_return"), mask);
  }

  void actions(const Json& tensor, Actions<double>& out) const {
    out.numbers = unpadded(tensor, mask);
    if (!architecture.discrete) return;
    for (const double a : out.numbers) out.classes.push_back(static_cast<int>(a));
    out.numbers.clear();
  }

  std::vector<double> parameters(const ParameterLayout& layout, const Json& values) const {
    std::vector<double> flat(layout.size());
    std::size_t filled = 0;
    for (const auto& [name, value] : values.items()) {
      const auto data = numbers(value);
      const auto& tensor = layout[name];
      EXPECT_EQ(data.size(), tensor.size()) << name;
      EXPECT_EQ(json.at("params").at(name).at("shape").get<std::vector<std::size_t>>(), tensor.shape) << name;
      std::copy(data.begin(), data.end(), flat.begin() + static_cast<std::ptrdiff_t>(tensor.offset));
      filled += data.size();
    }
    EXPECT_EQ(filled, layout.size());
    return flat;
  }

  Json json;
  Architecture architecture;
  std::vector<double> mask;
  Batch<double> batch;
};

void expect_near(const std::vector<double>& ours, const std::vector<double>& theirs, const std::string& what) {
  ASSERT_EQ(ours.size(), theirs.size()) << what;
  for (std::size_t i = 0; i < ours.size(); ++i) ASSERT_NEAR(ours[i], theirs[i], tolerance) << what << " [" << i << "]";
}

std::vector<double> values(const Matrix<double>& matrix) { return {matrix.data(), matrix.data() + matrix.size()}; }

/// The hidden states of tokens [first, first + count) of each round.
std::vector<double> states(const SelfConfirmingLoss<double>& loss, std::size_t first, std::size_t count) {
  const auto& hidden = loss.hidden();
  const auto read = loss.read();
  std::vector<double> out;
  for (Index row = 0; row < hidden.rows(); ++row) {
    const auto token = read[static_cast<std::size_t>(row) % read.size()];
    if (token < first || token >= first + count) continue;
    for (Index c = 0; c < hidden.cols(); ++c) out.push_back(hidden(row, c));
  }
  return out;
}

class GoldenFile : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(GoldenFile, OutputsLossesAndGradientsOfEveryMode) {
  const Golden golden(GetParam());
  const Network<double> network(golden.architecture);
  const auto parameters = golden.parameters(network.layout(), golden.json.at("params"));
  const Chunk<double> chunk{golden.batch, 0, 0, golden.batch.window_rounds};
  const auto& architecture = golden.architecture;
  for (const auto& [name, mode] : golden.json.at("modes").items()) {
    SCOPED_TRACE(name);
    SelfConfirmingLoss<double> loss(network, parse_loss_mode(name), true);
    std::vector<double> gradient(parameters.size());
    const auto losses =
        loss(parameters.data(), chunk, Denominators<double>(golden.batch), {Dropout(), Dropout()}, gradient.data());

    const auto& expected = mode.at("loss");
    EXPECT_NEAR(losses.total(), expected.at("total").get<double>(), tolerance);
    EXPECT_NEAR(losses.belief, expected.value("belief", 0.0), tolerance);
    EXPECT_NEAR(losses.action, expected.value("action", 0.0), tolerance);
    EXPECT_NEAR(losses.next_observation, expected.value("next_obs", 0.0), tolerance);
    EXPECT_NEAR(losses.next_return, expected.value("next_return", 0.0), tolerance);

    Matrix<double> belief = loss.predictions().belief;
    if (belief.size() == 0) {  // a mode without belief loss does not ask the head
      const Heads<double> heads(architecture, network.layout(), loss.read());
      heads.belief(parameters.data(), loss.hidden(), belief);
    }
    for (const auto& [key, value] : mode.at("outputs").items()) {
      if (key == "min_argmax_margin") continue;
      const auto theirs = unpadded(value, golden.mask);
      const std::map<std::string, std::function<std::vector<double>()>> ours{
          {"belief", [&] { return values(belief); }},
          {"action", [&] { return values(loss.predictions().action); }},
          {"next_obs", [&] { return values(loss.predictions().next_observation); }},
          {"next_return", [&] { return values(loss.predictions().next_return); }},
          {"h_obs", [&] { return states(loss, architecture.observation_token(0), architecture.agents); }},
          {"h_opp", [&] { return states(loss, architecture.opponent_token(), 1); }},
          {"h_act", [&] { return states(loss, architecture.action_token(0), architecture.agents); }},
          {"belief_token_fed_in_pass2", [&] {
             if (!architecture.discrete) return loss.fed().numbers;
             return std::vector<double>(loss.fed().classes.begin(), loss.fed().classes.end());
           }}};
      ASSERT_TRUE(ours.contains(key)) << key;
      expect_near(ours.at(key)(), theirs, key);
    }

    const auto without = mode.at("params_without_grad").get<std::vector<std::string>>();
    for (const auto& tensor : network.layout().tensors()) {
      const bool none = std::find(without.begin(), without.end(), tensor.name) != without.end();
      EXPECT_EQ(loss.untouched(tensor), none) << tensor.name;
      if (none) continue;
      const auto begin = gradient.begin() + static_cast<std::ptrdiff_t>(tensor.offset);
      expect_near({begin, begin + static_cast<std::ptrdiff_t>(tensor.size())},
                  numbers(mode.at("grads").at(tensor.name)), tensor.name);
    }
    EXPECT_NEAR(norm(std::span<const double>(gradient)), mode.at("grad_norm").get<double>(), tolerance);
  }
}

/// By the way that training goes: window by window, on several threads, only what the loss needs.
TEST_P(GoldenFile, LossesAndGradientsOfABatch) {
  const Golden golden(GetParam());
  const Network<double> network(golden.architecture);
  const auto parameters = golden.parameters(network.layout(), golden.json.at("params"));
  for (const auto& [name, mode] : golden.json.at("modes").items())
    for (const unsigned threads : {1U, 2U}) {
      SCOPED_TRACE(name);
      BatchGradient<double> gradient_of(network, parse_loss_mode(name), threads);
      std::vector<double> gradient(parameters.size(), 7.0);
      const auto losses = gradient_of(parameters, golden.batch, StepDropout(), gradient);
      EXPECT_NEAR(losses.total(), mode.at("loss").at("total").get<double>(), tolerance);
      std::vector<bool> touched(parameters.size());
      for (const auto& [begin, end] : gradient_of.touched())
        for (std::size_t i = begin; i < end; ++i) touched[i] = true;
      const auto without = mode.at("params_without_grad").get<std::vector<std::string>>();
      for (const auto& tensor : network.layout().tensors()) {
        const bool none = std::find(without.begin(), without.end(), tensor.name) != without.end();
        const auto begin = static_cast<std::ptrdiff_t>(tensor.offset);
        const auto end = begin + static_cast<std::ptrdiff_t>(tensor.size());
        EXPECT_EQ(std::count(touched.begin() + begin, touched.begin() + end, none), 0) << tensor.name;
        expect_near({gradient.begin() + begin, gradient.begin() + end},
                    none ? std::vector<double>(tensor.size()) : numbers(mode.at("grads").at(tensor.name)), tensor.name);
      }
      EXPECT_NEAR(norm(std::span<const double>(gradient)), mode.at("grad_norm").get<double>(), tolerance);
    }
}

/// Likewise.
TEST_P(GoldenFile, ThreeOptimiserSteps) {
  const Golden golden(GetParam());
  const auto& expected = golden.json.at("train3");
  const Network<double> network(golden.architecture);
  auto parameters = golden.parameters(network.layout(), golden.json.at("params"));
  BatchGradient<double> gradient_of(network, parse_loss_mode(expected.at("mode").get<std::string>()), 2);
  const AdamWSettings settings{.learning_rate = expected.at("lr"),
                               .weight_decay = expected.at("weight_decay"),
                               .beta_1 = expected.at("betas")[0],
                               .beta_2 = expected.at("betas")[1],
                               .epsilon = expected.at("eps"),
                               .clip = expected.at("clip"),
                               .warmup_steps = expected.at("warmup")};
  AdamWState<double> state;
  for (std::size_t step = 0; step < expected.at("losses").size(); ++step) {
    std::vector<double> gradient(parameters.size());
    const auto losses = gradient_of(parameters, golden.batch, StepDropout(), gradient);
    EXPECT_NEAR(losses.total(), expected.at("losses")[step].get<double>(), tolerance);
    EXPECT_NEAR(settings.rate(step), expected.at("lrs")[step].get<double>(), tolerance);
    const double length = adamw_step<double>(settings, gradient_of.touched(), gradient, state, parameters);
    EXPECT_NEAR(length, expected.at("grad_norms_before_clip")[step].get<double>(), tolerance);
  }
  const auto after = golden.parameters(network.layout(), expected.at("params_after"));
  for (const auto& tensor : network.layout().tensors())
    for (std::size_t i = tensor.offset; i < tensor.offset + tensor.size(); ++i)
      ASSERT_NEAR(parameters[i], after[i], tolerance) << tensor.name << " [" << i - tensor.offset << "]";
}

INSTANTIATE_TEST_SUITE_P(Reference, GoldenFile, testing::ValuesIn(golden_files()), [](const auto& file) {
  std::string name = file.param.stem().string();
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return name;
});
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(GoldenFile);

}  // namespace
}  // namespace folk::sct
