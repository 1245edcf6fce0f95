// Policies that look through a window: what they see at each step, and their files.

#include <folk/mpe/evaluation/episodes.h>
#include <folk/mpe/players/scripted.h>
#include <folk/mpe/players/window_policy.h>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "games/expect_error.h"
#include "mpe/players/conformance.h"
#include "mpe/players/safetensors_draft.h"

namespace folk::mpe {
namespace {

using folk::test::expect_error;
using testing::SafetensorsDraft;

WindowPolicy some_policy(const std::string& name, std::size_t context, std::vector<std::size_t> hidden = {9, 7},
                         std::uint64_t seed = 3) {
  const auto scenario = Scenario::named(name);
  WindowPolicy policy{name, context, {{0.25F, -0.5F, 0.125F}, {0.5F, 1.5F, 2}}, {}, {}, {}};
  std::vector<std::size_t> widths{context * team_observation_size(scenario)};
  widths.insert(widths.end(), hidden.begin(), hidden.end());
  widths.push_back(6);
  policy.shape = MlpShape(widths);
  policy.parameters = initial_parameters(policy.shape, seed, 1);
  return policy;
}

void expect_same(const WindowPolicy& one, const WindowPolicy& other) {
  EXPECT_EQ(one.scenario, other.scenario);
  EXPECT_EQ(one.context, other.context);
  EXPECT_EQ(one.scale, other.scale);
  EXPECT_EQ(one.shape, other.shape);
  EXPECT_EQ(one.parameters, other.parameters);
  EXPECT_EQ(one.notes, other.notes);
}

// ---- play --------------------------------------------------------------------------------------------------------

/// The network by its definition.
std::vector<double> network_output(const WindowPolicy& policy, std::vector<double> values) {
  const MlpShape& shape = policy.shape;
  for (std::size_t layer = 0; layer < shape.layers(); ++layer) {
    std::vector<double> next(shape.widths()[layer + 1]);
    for (std::size_t unit = 0; unit < next.size(); ++unit) {
      next[unit] = static_cast<double>(policy.parameters[shape.bias(layer) + unit]);
      for (std::size_t k = 0; k < values.size(); ++k)
        next[unit] +=
            static_cast<double>(policy.parameters[shape.weight(layer) + unit * values.size() + k]) * values[k];
      next[unit] = layer + 1 < shape.layers() ? std::max(next[unit], 0.0) : std::tanh(next[unit]);
    }
    values = next;
  }
  return values;
}

/// Holds what the predators of some episodes do at each step against the network applied to all that they saw so far.
class WindowExaminer final : public Watcher {
public:
  explicit WindowExaminer(const WindowPolicy& policy)
      : policy_(policy) {}

  void acted(const Layout& layout, const Block& block, const Moment& moment) override {
    seen_.resize(block.lanes);
    for (std::size_t lane = 0; lane < block.lanes; ++lane) {
      seen_[lane].push_back(observed(layout, block, lane));
      const auto wanted = network_output(policy_, window(seen_[lane]));
      for (std::size_t number = 0; number < wanted.size(); ++number)
        ASSERT_NEAR(block.actions[number * block_lanes + lane], wanted[number], 2e-5)
            << "lane " << lane << ", step " << moment.step << ", number " << number;
    }
  }

private:
  std::vector<double> observed(const Layout& layout, const Block& block, std::size_t lane) const {
    std::vector<double> numbers;
    for (std::size_t predator = 0; predator < 3; ++predator)
      for (std::size_t k = layout.observation_begin(predator); k < layout.observation_begin(predator + 1); ++k)
        numbers.push_back(
            (block.observations[k * block_lanes + lane] - static_cast<double>(policy_.scale.mean[predator])) /
            static_cast<double>(policy_.scale.deviation[predator]));
    return numbers;
  }

  std::vector<double> window(const std::vector<std::vector<double>>& seen) const {
    std::vector<double> numbers;
    for (std::size_t k = seen.size(); k < policy_.context; ++k) numbers.insert(numbers.end(), seen.front().size(), 0.0);
    for (std::size_t k = seen.size() - std::min(seen.size(), policy_.context); k < seen.size(); ++k)
      numbers.insert(numbers.end(), seen[k].begin(), seen[k].end());
    return numbers;
  }

  const WindowPolicy& policy_;
  std::vector<std::vector<std::vector<double>>> seen_;  // [lane][step][number]
};

TEST(WindowPolicy, ActsOnTheLastStepsOfItsEpisodeAndZerosBefore) {
  for (const char* name : {"simple_tag", "simple_world"})
    for (const std::size_t context : {1, 4, 20, 40}) {
      const Layout layout(Scenario::named(name));
      const auto policy = some_policy(name, context);
      const Cast cast{window_controller("window", policy, layout.scenario()), random_player()};
      play_episodes(layout, cast, {.seed = 4, .first = 30, .episodes = 3},
                    [&](std::size_t) { return std::make_unique<WindowExaminer>(policy); });
    }
}

TEST(WindowPolicy, ForgetsAnEpisodeThatWasLeftAfterItsFirstStep) {
  const auto scenario = Scenario::named("simple_tag");
  const Layout layout(scenario);
  const auto controller = window_controller("window", some_policy("simple_tag", 3), scenario);
  const auto first_deed = [&](Player& player, std::uint64_t episode) {
    Batch batch(scenario, 1);
    batch.reset(1, episode);
    const Block block = batch.block(0);
    player.start(layout, block, 1, {});
    player.act(layout, block, 1, {});
    return *action_rows(block, 1).x;
  };
  const auto stays = controller.player(layout, 1);
  const double left = first_deed(*stays, 7);
  const double next = first_deed(*stays, 8);
  EXPECT_NE(left, next);
  EXPECT_EQ(next, first_deed(*controller.player(layout, 1), 8));
}

TEST(WindowPolicy, PlaysAsAllControllersMust) {
  for (const char* name : {"simple_tag", "simple_world"})
    testing::expect_sound_controller(window_controller("window", some_policy(name, 5), Scenario::named(name)),
                                     Side::predators, Scenario::named(name));
}

TEST(WindowPolicy, PlaysTheSameOnAnyNumberOfThreads) {
  const Layout layout(Scenario::named("simple_tag"));
  const Cast cast{window_controller("window", some_policy("simple_tag", 20), layout.scenario()), random_player()};
  const auto returns = [&](unsigned threads) {
    std::vector<double> sums;
    for (const auto& score : score_episodes(layout, cast, {.seed = 4, .episodes = 150, .threads = threads}))
      sums.push_back(score.predators);
    return sums;
  };
  EXPECT_EQ(returns(1), returns(3));
}

TEST(WindowPolicy, IsForThePredatorsOfItsScenario) {
  expect_error<UsageError>(
      [] { window_controller("w", some_policy("simple_tag", 2), Scenario::named("simple_world")); },
      "w: a policy for simple_tag, not for simple_world");
  const auto scenario = Scenario::named("simple_tag");
  const auto controller = window_controller("w", some_policy("simple_tag", 2), scenario);
  expect_error<UsageError>([&] { controller.team(Layout(scenario), Side::prey); },
                           "w: a policy of the predators, not of the prey");
  const Layout other(Scenario::named("simple_world"));
  expect_error<UsageError>([&] { controller.team(other, Side::predators); }, "other observations than simple_world");
}

// ---- files -------------------------------------------------------------------------------------------------------

RC_GTEST_PROP(WindowPolicyFile, WhatIsWrittenIsReadAgain, ()) {
  const auto hidden = *rc::gen::container<std::vector<std::size_t>>(*rc::gen::inRange<std::size_t>(0, 4),
                                                                    rc::gen::inRange<std::size_t>(1, 9));
  auto policy = some_policy(*rc::gen::element("simple_tag", "simple_world"), *rc::gen::inRange<std::size_t>(1, 22),
                            hidden, *rc::gen::inRange<std::uint64_t>(0, 100));
  policy.notes["made by"] = "a \"test\", \xC3\xA9";
  const auto bytes = window_policy_bytes(policy);
  expect_same(parse_window_policy(bytes, "policy"), policy);
  RC_ASSERT(window_policy_bytes(parse_window_policy(bytes, "policy")) == bytes);
}

TEST(WindowPolicyFile, IsAsItsHeaderDescribesIt) {
  const auto draft = SafetensorsDraft::of(window_policy_bytes(some_policy("simple_world", 20)));
  EXPECT_EQ(draft.metadata.at("format"), "folk-mpe-window-1");
  EXPECT_EQ(draft.metadata.at("scenario"), "simple_world");
  EXPECT_EQ(draft.metadata.at("context"), "20");
  EXPECT_EQ(draft.tensors.size(), 8U);
  EXPECT_EQ(draft.tensors.at("fc1.weight").shape, (std::vector<std::uint64_t>{9, 1440}));
  EXPECT_EQ(draft.tensors.at("fc3.bias").shape, (std::vector<std::uint64_t>{6}));
  EXPECT_EQ(draft.tensors.at("scale.mean").shape, (std::vector<std::uint64_t>{3}));
  EXPECT_EQ(draft.tensors.at("scale.deviation").shape, (std::vector<std::uint64_t>{3}));
}

/// What is said of a file after a change.
void expect_window_refusal(const std::function<void(SafetensorsDraft&)>& change, const std::string& part) {
  auto draft = SafetensorsDraft::of(window_policy_bytes(some_policy("simple_tag", 3, {4})));
  parse_window_policy(draft.bytes(), "unchanged");
  change(draft);
  expect_error<InputFileError>([&] { parse_window_policy(draft.bytes(), "w.safetensors"); }, "w.safetensors: " + part);
}

TEST(WindowPolicyRefusal, OfWhatIsNoSuchFile) {
  for (const std::string bytes : {"", "x", "no policy at all", "{\"a\": 1}"})
    expect_error<InputFileError>([&] { parse_window_policy(bytes, "p\nq"); }, "p?q: ");
  const auto whole = window_policy_bytes(some_policy("simple_tag", 3, {4}));
  expect_error<InputFileError>([&] { parse_window_policy(whole.substr(0, whole.size() - 1), "p"); }, "p: ");
  expect_error<InputFileError>([&] { parse_window_policy(whole + "1234", "p"); }, "p: 4 bytes too many");
}

TEST(WindowPolicyRefusal, OfOtherMetadata) {
  for (const char* key : {"format", "scenario", "context"})
    expect_window_refusal([&](SafetensorsDraft& d) { d.metadata.erase(key); },
                          fmt::format("metadata '{}' is missing", key));
  expect_window_refusal([](SafetensorsDraft& d) { d.metadata["format"] = "folk-mpe-1"; },
                        "format 'folk-mpe-1': expected folk-mpe-window-1");
  expect_window_refusal([](SafetensorsDraft& d) { d.metadata["scenario"] = "chess"; }, "");
  for (const char* context : {"", "0", "-3", "+3", " 3", "3 ", "3.0", "0x3", "99999999999999999999999"})
    expect_window_refusal([&](SafetensorsDraft& d) { d.metadata["context"] = context; },
                          fmt::format("context '{}': expected a whole number of steps, at least 1", context));
}

TEST(WindowPolicyRefusal, OfTensorsThatAreMissingOrTooMany) {
  for (const char* name : {"scale.mean", "scale.deviation", "fc1.weight", "fc1.bias", "fc2.bias"})
    expect_window_refusal([&](SafetensorsDraft& d) { d.tensors.erase(name); },
                          fmt::format("tensor '{}' is missing", name));
  for (const char* name : {"extra", "agent0.fc1.weight", "fc4.bias"})
    expect_window_refusal([&](SafetensorsDraft& d) { d.put(name, {1}); },
                          fmt::format("tensor '{}' has no place in a policy", name));
}

TEST(WindowPolicyRefusal, OfOtherShapes) {
  expect_window_refusal(
      [](SafetensorsDraft& d) { d.metadata["context"] = "2"; },
      "a network of 144 inputs: expected 2 steps of the 48 numbers that simple_tag's predators observe");
  expect_window_refusal([](SafetensorsDraft& d) { d.metadata["scenario"] = "simple_world"; },
                        "a network of 144 inputs: expected 3 steps of the 72 numbers");
  expect_window_refusal(
      [](SafetensorsDraft& d) {
        d.put("fc1.weight", {4, 145});
      },
      "a network of 145 inputs: expected 3 steps");
  expect_window_refusal(
      [](SafetensorsDraft& d) {
        d.put("fc2.weight", {2, 4}), d.put("fc2.bias", {2});
      },
      "a network of 2 outputs: expected 6, two a predator");
  expect_window_refusal([](SafetensorsDraft& d) { d.put("fc1.bias", {5}); },
                        "tensor 'fc1.bias' has shape (5): expected (4)");
  for (const char* name : {"scale.mean", "scale.deviation"})
    for (const std::uint64_t size : {1, 2, 4})
      expect_window_refusal([&](SafetensorsDraft& d) { d.put(name, {size}); },
                            fmt::format("tensor '{}' has shape ({}): expected (3)", name, size));
}

TEST(WindowPolicyRefusal, OfNumbersThatMakeNoSense) {
  for (const char* name : {"scale.mean", "scale.deviation", "fc1.weight", "fc2.bias"})
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()})
      expect_window_refusal([&](SafetensorsDraft& d) { d.set_number(name, 1, bad); },
                            fmt::format("tensor '{}' holds a number that is not finite", name));
  for (const float bad : {0.0F, -1.0F})
    expect_window_refusal([&](SafetensorsDraft& d) { d.set_number("scale.deviation", 2, bad); },
                          "tensor 'scale.deviation' holds a number that is not above 0");
}

TEST(WindowPolicyRefusal, OfWritingWhatCouldNotBeRead) {
  auto policy = some_policy("simple_tag", 3);
  policy.context = 4;
  expect_error<UsageError>([&] { window_policy_bytes(policy); }, "could not be read again");
  policy = some_policy("simple_tag", 3);
  policy.scale.mean.pop_back();
  expect_error<UsageError>([&] { window_policy_bytes(policy); }, "could not be read again");
  policy = some_policy("simple_tag", 3);
  policy.parameters[7] = std::numeric_limits<float>::infinity();
  expect_error<UsageError>([&] { window_policy_bytes(policy); }, "could not be read again");
}

}  // namespace
}  // namespace folk::mpe
