// Batch-constrained policies: their files, what is refused of them, and how they choose.

#include <folk/mpe/players/bcq_policy.h>
#include <folk/mpe/players/scripted.h>
#include <folk/mpe/world/batch.h>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "games/expect_error.h"
#include "mpe/offline/plain_network.h"
#include "mpe/players/conformance.h"
#include "mpe/players/safetensors_draft.h"

namespace folk::mpe {
namespace {

using folk::test::expect_error;
using test::as_double;
using test::joined;
using test::plain_network;
using testing::SafetensorsDraft;

StoredNetwork any_network(std::vector<std::size_t> widths, std::uint64_t number) {
  const MlpShape shape(std::move(widths));
  return {shape, initial_parameters(shape, 5, number)};
}

BcqPolicy any_policy(const std::string& scenario, std::size_t candidates = 7, std::size_t latent = 4) {
  BcqPolicy policy{scenario, {}, candidates, 0.3, {{"made by", "a \"test\", \xC3\xA9"}}};
  const auto named = Scenario::named(scenario);
  for (std::size_t agent = 0; agent < named.predators(); ++agent) {
    const std::size_t observed = named.observation_size(agent);
    policy.networks.push_back({any_network({observed + latent, 6, 5, 2}, 10 * agent),
                               any_network({observed + 2, 4, 2}, 10 * agent + 1),
                               any_network({observed + 2, 5, 1}, 10 * agent + 2)});
  }
  return policy;
}

void expect_same(const StoredNetwork& one, const StoredNetwork& other) {
  EXPECT_EQ(one.shape, other.shape);
  EXPECT_EQ(one.parameters, other.parameters);
}

// ---- files -------------------------------------------------------------------------------------------------------

RC_GTEST_PROP(BcqPolicy, WhatIsWrittenIsReadAgain, ()) {
  auto policy = any_policy(*rc::gen::element<std::string>("simple_tag", "simple_world"),
                           *rc::gen::inRange<std::size_t>(1, 10'001), *rc::gen::inRange<std::size_t>(1, 9));
  policy.perturbation = *rc::gen::element(0.0, 0.05, 1.0 / 3, 2.0);
  const auto bytes = bcq_policy_bytes(policy);
  const auto again = parse_bcq_policy(bytes, "policy");
  RC_ASSERT(again.scenario == policy.scenario);
  RC_ASSERT(again.candidates == policy.candidates);
  RC_ASSERT(again.perturbation == policy.perturbation);
  RC_ASSERT(again.notes == policy.notes);
  ASSERT_EQ(again.networks.size(), 3U);
  for (std::size_t agent = 0; agent < 3; ++agent) {
    expect_same(again.networks[agent].decoder, policy.networks[agent].decoder);
    expect_same(again.networks[agent].perturbation, policy.networks[agent].perturbation);
    expect_same(again.networks[agent].critic, policy.networks[agent].critic);
  }
  RC_ASSERT(bcq_policy_bytes(again) == bytes);
}

TEST(BcqPolicy, IsAsItsHeaderDescribesIt) {
  const auto policy = any_policy("simple_tag");
  const auto draft = SafetensorsDraft::of(bcq_policy_bytes(policy));
  EXPECT_EQ(draft.metadata.at("format"), "folk-mpe-bcq-1");
  EXPECT_EQ(draft.metadata.at("scenario"), "simple_tag");
  EXPECT_EQ(draft.metadata.at("candidates"), "7");
  EXPECT_EQ(draft.metadata.at("perturbation"), "0.3");
  EXPECT_EQ(draft.metadata.size(), 5U);
  EXPECT_EQ(draft.tensors.size(), 3U * (6 + 4 + 4));
  EXPECT_EQ(draft.tensors.at("agent2.decoder.fc1.weight").shape, (std::vector<std::uint64_t>{6, 20}));
  EXPECT_EQ(draft.tensors.at("agent0.critic.fc2.bias").shape, (std::vector<std::uint64_t>{1}));
  float first = 0;
  std::memcpy(&first, draft.tensors.at("agent1.perturbation.fc2.weight").data.data(), sizeof first);
  const auto& network = policy.networks[1].perturbation;
  EXPECT_EQ(first, network.parameters[network.shape.weight(1)]);
}

/// What is said of a file after a change.
void expect_bcq_refusal(const std::function<void(SafetensorsDraft&)>& change, const std::string& part) {
  auto draft = SafetensorsDraft::of(bcq_policy_bytes(any_policy("simple_tag")));
  parse_bcq_policy(draft.bytes(), "unchanged");
  change(draft);
  expect_error<InputFileError>([&] { parse_bcq_policy(draft.bytes(), "p\nq"); }, "p?q: " + part);
}

TEST(BcqPolicyRefusal, OfWhatIsNoSuchFile) {
  for (const std::string bytes : {"", "x", "no policy at all"})
    expect_error<InputFileError>([&] { parse_bcq_policy(bytes, "p\nq"); }, "p?q: ");
  const auto whole = bcq_policy_bytes(any_policy("simple_tag"));
  expect_error<InputFileError>([&] { parse_bcq_policy(whole.substr(0, whole.size() - 1), "p"); }, "p: ");
  expect_error<InputFileError>([&] { parse_bcq_policy(whole + "1234", "p"); }, "p: 4 bytes too many");
}

TEST(BcqPolicyRefusal, OfOtherMetadata) {
  for (const char* key : {"format", "scenario", "candidates", "perturbation"})
    expect_bcq_refusal([&](SafetensorsDraft& d) { d.metadata.erase(key); },
                       fmt::format("metadata '{}' is missing", key));
  expect_bcq_refusal([](SafetensorsDraft& d) { d.metadata["format"] = "folk-mpe-1"; },
                     "format 'folk-mpe-1': expected folk-mpe-bcq-1");
  expect_bcq_refusal([](SafetensorsDraft& d) { d.metadata["scenario"] = "simple\nspread"; },
                     "scenario 'simple?spread': expected simple_tag or simple_world");
  for (const char* word : {"", "0", "10001", "-1", "1.5", "7 ", " 7", "x", "99999999999999999999999"})
    expect_bcq_refusal([&](SafetensorsDraft& d) { d.metadata["candidates"] = word; },
                       fmt::format("candidates '{}': expected a number from 1 to 10000", word));
  for (const char* word : {"", "-0.1", "2.1", "nan", "inf", "0.05x"})
    expect_bcq_refusal([&](SafetensorsDraft& d) { d.metadata["perturbation"] = word; },
                       fmt::format("perturbation '{}': expected a number from 0 to 2", word));
}

TEST(BcqPolicyRefusal, OfTensorsThatAreMissingOrTooMany) {
  for (const char* name : {"agent0.decoder.fc1.weight", "agent1.perturbation.fc2.bias", "agent2.critic.fc1.bias"})
    expect_bcq_refusal([&](SafetensorsDraft& d) { d.tensors.erase(name); },
                       fmt::format("tensor '{}' is missing", name));
  for (const char* name : {"extra", "agent3.critic.fc1.bias", "agent0.decoder.fc5.bias", "agent0.fc1.weight"})
    expect_bcq_refusal([&](SafetensorsDraft& d) { d.put(name, {1}); },
                       fmt::format("tensor '{}' has no place in a policy", name));
}

TEST(BcqPolicyRefusal, OfOtherShapesAndNumbers) {
  const auto put = [](const char* name, std::vector<std::uint64_t> shape) {
    return [name, shape](SafetensorsDraft& d) { d.put(name, shape); };
  };
  expect_bcq_refusal(put("agent0.decoder.fc1.weight", {6, 16}),
                     "the decoder of agent0 has 16 inputs: expected more than 16, what is observed");
  expect_bcq_refusal(put("agent1.perturbation.fc1.weight", {4, 17}),
                     "the perturbation of agent1 has 17 inputs: expected 18, what is observed and an action");
  expect_bcq_refusal(put("agent2.critic.fc1.weight", {5, 19}),
                     "the critic of agent2 has 19 inputs: expected 18, what is observed and an action");
  expect_bcq_refusal([](SafetensorsDraft& d) { d.metadata["scenario"] = "simple_world"; },
                     "the decoder of agent0 has 20 inputs: expected more than 24");
  const auto outputs = [](const char* part, std::uint64_t inputs, std::uint64_t count) {
    return [=](SafetensorsDraft& d) {
      d.put(fmt::format("agent1.{}.weight", part), {count, inputs});
      d.put(fmt::format("agent1.{}.bias", part), {count});
    };
  };
  expect_bcq_refusal(outputs("decoder.fc3", 5, 3), "the decoder of agent1 has 3 outputs: expected 2");
  expect_bcq_refusal(outputs("perturbation.fc2", 4, 1), "the perturbation of agent1 has 1 outputs: expected 2");
  expect_bcq_refusal(outputs("critic.fc2", 5, 2), "the critic of agent1 has 2 outputs: expected 1");
  expect_bcq_refusal(put("agent0.critic.fc1.weight", {5000, 18}), "tensor 'agent0.critic.fc1.weight' has shape");
  expect_bcq_refusal([](SafetensorsDraft& d) { d.tensors["agent1.critic.fc2.weight"].dtype = "F64"; },
                     "tensor 'agent1.critic.fc2.weight' has type F64: expected F32");
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::infinity()})
    expect_bcq_refusal([&](SafetensorsDraft& d) { d.set_number("agent2.decoder.fc3.bias", 1, bad); },
                       "tensor 'agent2.decoder.fc3.bias' holds a number that is not finite");
}

TEST(BcqPolicyToWrite, MustBeOneThatCanBeRead) {
  const auto refuse = [](const std::function<void(BcqPolicy&)>& change, const std::string& part) {
    auto policy = any_policy("simple_tag");
    change(policy);
    expect_error<UsageError>([&] { bcq_policy_bytes(policy); },
                             "a policy that could not be read again: policy: " + part);
  };
  refuse([](BcqPolicy& p) { p.networks.pop_back(); }, "tensor 'agent2.decoder.fc1.weight' is missing");
  refuse([](BcqPolicy& p) { p.networks.push_back(p.networks[0]); }, "tensor 'agent3.critic.fc1.bias' has no place");
  refuse([](BcqPolicy& p) { p.networks[1].critic.parameters[0] = NAN; }, "tensor 'agent1.critic.fc1.weight' holds");
  refuse([](BcqPolicy& p) { p.candidates = 0; }, "candidates '0'");
  refuse([](BcqPolicy& p) { p.perturbation = NAN; }, "perturbation 'nan'");
  refuse([](BcqPolicy& p) { p.scenario = "simple_spread"; }, "scenario 'simple_spread'");
}

// ---- play --------------------------------------------------------------------------------------------------------

Controller any_controller(const char* scenario, std::size_t candidates) {
  return bcq_controller("bcq", any_policy(scenario, candidates), Scenario::named(scenario));
}

TEST(BcqController, IsSound) {
  for (const char* scenario : {"simple_tag", "simple_world"})
    testing::expect_sound_controller(any_controller(scenario, 7), Side::predators, Scenario::named(scenario));
}

TEST(BcqControllerThreads, MayShareAController) {
  const Layout layout(Scenario::named("simple_tag"));
  const auto shared = any_controller("simple_tag", 7);
  std::vector<std::vector<testing::Deeds>> deeds(3);
  std::vector<std::jthread> threads;
  for (auto& mine : deeds)
    threads.emplace_back([&] { mine = testing::Table(layout, shared, Side::predators).play(5, 0, 64); });
  threads.clear();
  EXPECT_EQ(deeds[1], deeds[0]);
  EXPECT_EQ(deeds[2], deeds[0]);
}

/// The best of an agent's candidates, in double.
std::vector<double> plain_action(const BcqPolicy& policy, const std::vector<double>& observation, RandomStream random,
                                 std::size_t agent) {
  const auto& networks = policy.networks[agent];
  const auto run = [](const StoredNetwork& network, const std::vector<double>& input) {
    return plain_network(network.shape, as_double(network.parameters).data(), input);
  };
  double best = -std::numeric_limits<double>::infinity();
  std::vector<double> chosen;
  for (std::size_t i = 0; i < policy.candidates; ++i) {
    std::vector<double> latent;
    while (observation.size() + latent.size() < networks.decoder.shape.inputs())
      latent.push_back(std::clamp(random.normal(), -0.5, 0.5));
    auto action = run(networks.decoder, joined(observation, latent));
    for (double& number : action) number = std::tanh(number);
    const auto shift = run(networks.perturbation, joined(observation, action));
    for (std::size_t c = 0; c < 2; ++c)
      action[c] = std::clamp(action[c] + policy.perturbation * std::tanh(shift[c]), -1.0, 1.0);
    const double value = run(networks.critic, joined(observation, action))[0];
    if (value > best) best = value, chosen = action;
  }
  return chosen;
}

/// Some lanes of a block; their candidates are computed together, or each lane's alone.
void expect_best(std::size_t candidates) {
  const Layout layout(Scenario::named("simple_world"));
  auto policy = any_policy("simple_world", candidates);
  policy.perturbation = 1.5;  // so that some are cut
  for (auto& networks : policy.networks)
    for (float& number : networks.decoder.parameters) number *= 3;
  Batch batch(layout.scenario(), 5);
  batch.reset(4, 20);
  const Block block = batch.block(0);
  const auto controller = bcq_controller("bcq", policy, layout.scenario());
  for (std::size_t agent = 0; agent < 3; ++agent) {
    controller.player(layout, agent)->act(layout, block, agent, {4, 20, 6});
    const auto [x, y] = action_rows(block, agent);
    for (std::size_t lane = 0; lane < 5; ++lane) {
      std::vector<double> observation;
      for (std::size_t k = 0; k < layout.scenario().observation_size(agent); ++k)
        observation.push_back(block.observations[(layout.observation_begin(agent) + k) * block_lanes + lane]);
      const auto wanted =
          plain_action(policy, observation, random_stream(4, RandomUse::policy, 20 + lane, 6, agent), agent);
      EXPECT_NEAR(x[lane], wanted[0], 1e-5);
      EXPECT_NEAR(y[lane], wanted[1], 1e-5);
    }
  }
}

TEST(BcqController, TakesTheBestOfWhatItDraws) {
  for (const std::size_t candidates : {1, 7, 100, 300}) expect_best(candidates);
}

TEST(BcqController, IsForPredatorsOfOneScenario) {
  const auto tag = Scenario::named("simple_tag");
  expect_error<UsageError>([&] { bcq_controller("b", any_policy("simple_world"), tag); },
                           "b: a policy for simple_world, not for simple_tag");
  const auto controller = bcq_controller("b", any_policy("simple_tag"), tag);
  EXPECT_EQ(controller.name, "b");
  expect_error<UsageError>([&] { controller.player(Layout(tag), 3); }, "b: a policy of the predators, not of the prey");
  // A scenario of the same name with more in it.
  auto larger = tag;
  larger.entities.insert(larger.entities.begin(), larger.entities.front());
  expect_error<UsageError>([&] { bcq_controller("b", any_policy("simple_tag"), larger).player(Layout(larger), 0); },
                           "b: has no networks for agent 0, who observes 18 numbers");
}

}  // namespace
}  // namespace folk::mpe
