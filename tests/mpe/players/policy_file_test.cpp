// Policies as files: what is written is read again, and what is no policy is refused in one line that says why.

#include <folk/games/text_file.h>
#include <folk/mpe/players/policy_file.h>
#include <folk/mpe/world/batch.h>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "games/expect_error.h"
#include "mpe/players/named_players.h"
#include "mpe/players/safetensors_draft.h"

namespace folk::mpe {
namespace {

using folk::test::expect_error;
using testing::SafetensorsDraft;

Policy predators_of_tag() { return untrained_policy(Scenario::named("simple_tag"), Side::predators, 3, 4); }

/// The published form of a prey of simple_tag, every number 0.5.
SafetensorsDraft published_prey() {
  SafetensorsDraft draft;
  for (const char* name : {"in_fn.weight", "in_fn.bias", "in_fn.running_mean", "in_fn.running_var"})
    draft.put(name, {14});
  draft.put("fc1.weight", {3, 14});
  draft.put("fc1.bias", {3});
  draft.put("fc2.weight", {2, 3});
  draft.put("fc2.bias", {2});
  return draft;
}

/// Of so many inputs, no two numbers the same.
InputNormalisation some_normalisation(std::size_t inputs) {
  InputNormalisation normalisation;
  for (std::size_t k = 0; k < inputs; ++k) {
    const float x = static_cast<float>(k);
    normalisation.weight.push_back(1 + x / 100);
    normalisation.bias.push_back(x / 10 - 3);
    normalisation.mean.push_back(-x);
    normalisation.variance.push_back(x * x);  // the first 0
  }
  return normalisation;
}

/// The second of them normalises.
Policy normalising_predators() {
  auto policy = predators_of_tag();
  policy.networks[1].normalisation = some_normalisation(16);
  return policy;
}

void expect_same(const Policy& one, const Policy& other) {
  EXPECT_EQ(one.scenario, other.scenario);
  EXPECT_EQ(one.side, other.side);
  EXPECT_EQ(one.notes, other.notes);
  ASSERT_EQ(one.networks.size(), other.networks.size());
  for (std::size_t i = 0; i < one.networks.size(); ++i) {
    EXPECT_EQ(one.networks[i].shape, other.networks[i].shape);
    EXPECT_EQ(one.networks[i].parameters, other.networks[i].parameters);
    EXPECT_EQ(one.networks[i].squash, other.networks[i].squash);
    const auto& here = one.networks[i].normalisation;
    const auto& there = other.networks[i].normalisation;
    ASSERT_EQ(here.has_value(), there.has_value());
    if (!here) continue;
    EXPECT_EQ(here->weight, there->weight);
    EXPECT_EQ(here->bias, there->bias);
    EXPECT_EQ(here->mean, there->mean);
    EXPECT_EQ(here->variance, there->variance);
    EXPECT_EQ(here->epsilon, there->epsilon);
  }
}

// ---- what can be read --------------------------------------------------------------------------------------------

RC_GTEST_PROP(PolicyFile, WhatIsWrittenIsReadAgain, ()) {
  const auto scenario = Scenario::named(*rc::gen::element("simple_tag", "simple_world"));
  const Side side = *rc::gen::element(Side::predators, Side::prey);
  auto policy = untrained_policy(scenario, side, *rc::gen::inRange<std::uint64_t>(0, 100), 3);
  if (*rc::gen::arbitrary<bool>()) policy.networks.resize(1);  // shared
  const auto squash = *rc::gen::element(Squash::tanh, Squash::clamp);
  for (auto& network : policy.networks) {
    auto widths = *rc::gen::container<std::vector<std::size_t>>(*rc::gen::inRange<std::size_t>(0, 4),
                                                                rc::gen::inRange<std::size_t>(1, 9));
    widths.insert(widths.begin(), network.shape.inputs());
    widths.push_back(2);
    network.shape = MlpShape(widths);
    network.parameters = initial_parameters(network.shape, 7, 1);
    network.squash = squash;
    if (*rc::gen::arbitrary<bool>()) network.normalisation = some_normalisation(network.shape.inputs());
  }
  policy.notes["made by"] = "a \"test\", \xC3\xA9";
  const auto bytes = policy_bytes(policy);
  expect_same(parse_policy(bytes, "policy"), policy);
  RC_ASSERT(policy_bytes(parse_policy(bytes, "policy")) == bytes);
}

TEST(PolicyFile, IsAFile) {
  const testing::TemporaryFolder folder;
  const auto path = folder.path() / "policy.safetensors";
  write_policy(path, predators_of_tag());
  expect_same(read_policy(path), predators_of_tag());
  EXPECT_EQ(read_file(path, largest_policy_file), policy_bytes(predators_of_tag()));
  expect_error<InputFileError>([&] { read_policy(folder.path() / "none"); }, "none");
  expect_error<InputFileError>([&] { read_policy(folder.path()); }, folder.path().string());
  expect_error<EnvironmentError>([&] { write_policy(folder.path() / "no" / "policy", predators_of_tag()); }, "no");
}

TEST(PolicyFile, IsAsItsHeaderDescribesIt) {
  const auto draft = SafetensorsDraft::of(policy_bytes(predators_of_tag()));
  EXPECT_EQ(draft.metadata.at("format"), "folk-mpe-1");
  EXPECT_EQ(draft.metadata.at("scenario"), "simple_tag");
  EXPECT_EQ(draft.metadata.at("side"), "predators");
  EXPECT_EQ(draft.metadata.at("squash"), "tanh");
  EXPECT_EQ(draft.tensors.size(), 18U);
  EXPECT_EQ(draft.tensors.at("agent2.fc1.weight").shape, (std::vector<std::uint64_t>{4, 16}));
  EXPECT_EQ(draft.tensors.at("agent0.fc3.bias").shape, (std::vector<std::uint64_t>{2}));
  float first = 0;
  std::memcpy(&first, draft.tensors.at("agent1.fc2.weight").data.data(), sizeof first);
  const auto network = predators_of_tag().networks[1];
  EXPECT_EQ(first, network.parameters[network.shape.weight(1)]);
}

TEST(PolicyFile, HasTheNormalisationOfAgentsThatHaveOne) {
  const auto draft = SafetensorsDraft::of(policy_bytes(normalising_predators()));
  EXPECT_EQ(draft.tensors.size(), 18U + 4U);
  const auto normalisation = some_normalisation(16);
  for (const auto& [name, numbers] :
       {std::pair{"weight", normalisation.weight}, std::pair{"bias", normalisation.bias},
        std::pair{"mean", normalisation.mean}, std::pair{"variance", normalisation.variance}}) {
    const auto& tensor = draft.tensors.at(fmt::format("agent1.norm.{}", name));
    EXPECT_EQ(tensor.shape, (std::vector<std::uint64_t>{16}));
    std::vector<float> there(16);
    ASSERT_EQ(tensor.data.size(), 64U);
    std::memcpy(there.data(), tensor.data.data(), 64);
    EXPECT_EQ(there, numbers);
  }
}

TEST(PublishedPolicy, IsReadWithItsNormalisation) {
  auto draft = published_prey();
  draft.tensors["in_fn.num_batches_tracked"] = {"I64", {}, std::string(8, '\1')};
  draft.set_number("in_fn.running_mean", 3, -7);
  draft.set_number("in_fn.running_var", 0, 0);
  draft.set_number("fc1.weight", 14 + 2, 9);
  draft.metadata = {{"source", "somewhere"}};
  const auto policy = parse_policy(draft.bytes(), "prey");
  EXPECT_EQ(policy.scenario, "simple_tag");
  EXPECT_EQ(policy.side, Side::prey);
  EXPECT_EQ(policy.notes, draft.metadata);
  ASSERT_EQ(policy.networks.size(), 1U);
  const auto& network = policy.networks[0];
  EXPECT_EQ(network.shape, MlpShape({14, 3, 2}));
  EXPECT_EQ(network.squash, Squash::clamp);
  EXPECT_EQ(network.parameters[14 + 2], 9);
  EXPECT_EQ(network.parameters[network.shape.bias(1)], 0.5F);
  ASSERT_TRUE(network.normalisation.has_value());
  EXPECT_EQ(network.normalisation->mean[3], -7);
  EXPECT_EQ(network.normalisation->variance[0], 0);
  EXPECT_EQ(network.normalisation->weight, std::vector<float>(14, 0.5F));
  EXPECT_EQ(network.normalisation->epsilon, 1e-5);
}

TEST(PublishedPolicy, IsForWhomItsWidthSays) {
  const std::map<std::uint64_t, std::pair<std::string, Side>> widths{{16, {"simple_tag", Side::predators}},
                                                                     {14, {"simple_tag", Side::prey}},
                                                                     {24, {"simple_world", Side::predators}},
                                                                     {22, {"simple_world", Side::prey}}};
  for (const auto& [width, meant] : widths) {
    SafetensorsDraft draft;
    draft.put("fc1.weight", {2, width});
    draft.put("fc1.bias", {2});
    const auto policy = parse_policy(draft.bytes(), "policy");
    EXPECT_EQ(policy.scenario, meant.first);
    EXPECT_EQ(policy.side, meant.second);
    EXPECT_EQ(policy.networks[0].squash, meant.second == Side::prey ? Squash::clamp : Squash::tanh);
    EXPECT_FALSE(policy.networks[0].normalisation.has_value());
  }
}

TEST(PublishedPolicy, OfTheReleasedPreyIsShipped) {
  for (const char* scenario : {"simple_tag", "simple_world"}) {
    const auto policy = read_policy(fmt::format("{}/data/mpe/{}_released.safetensors", FOLK_SOURCE_DIR, scenario));
    EXPECT_EQ(policy.scenario, scenario);
    EXPECT_EQ(policy.side, Side::prey);
    EXPECT_EQ(policy.networks.at(0).shape, MlpShape({scenario == std::string("simple_tag") ? 14U : 22U, 64, 64, 2}));
  }
}

// ---- what is refused ---------------------------------------------------------------------------------------------

void expect_file_refusal(const SafetensorsDraft& draft, const std::string& part) {
  expect_error<InputFileError>([&] { parse_policy(draft.bytes(), "p.safetensors"); }, "p.safetensors: " + part);
}

/// What is said of a file of Folk's own after a change.
void expect_refusal_of_own(const std::function<void(SafetensorsDraft&)>& change, const std::string& part) {
  auto draft = SafetensorsDraft::of(policy_bytes(predators_of_tag()));
  parse_policy(draft.bytes(), "unchanged");
  change(draft);
  expect_file_refusal(draft, part);
}

/// The same of one whose second agent normalises.
void expect_refusal_of_normalising(const std::function<void(SafetensorsDraft&)>& change, const std::string& part) {
  auto draft = SafetensorsDraft::of(policy_bytes(normalising_predators()));
  parse_policy(draft.bytes(), "unchanged");
  change(draft);
  expect_file_refusal(draft, part);
}

/// The same of the published form.
void expect_refusal_of_published(const std::function<void(SafetensorsDraft&)>& change, const std::string& part) {
  auto draft = published_prey();
  parse_policy(draft.bytes(), "unchanged");
  change(draft);
  expect_file_refusal(draft, part);
}

TEST(PolicyRefusal, OfWhatIsNoSuchFile) {
  for (const std::string bytes : {"", "x", "no policy at all", "{\"a\": 1}"})
    expect_error<InputFileError>([&] { parse_policy(bytes, "p\nq"); }, "p?q: ");
  const auto whole = policy_bytes(predators_of_tag());
  for (const std::size_t size : {8, 9, 100, 1000, static_cast<int>(whole.size()) - 1})
    expect_error<InputFileError>([&] { parse_policy(whole.substr(0, size), "p"); }, "p: ");
  expect_error<InputFileError>([&] { parse_policy(whole + "1234", "p"); }, "p: 4 bytes too many");
  expect_file_refusal({}, "tensor 'fc1.weight' is missing; it is no policy of this form");
}

TEST(PolicyRefusal, OfTensorsThatAreMissingOrTooMany) {
  for (const char* name : {"agent0.fc1.weight", "agent1.fc2.bias", "agent2.fc3.bias"})
    expect_refusal_of_own([&](SafetensorsDraft& d) { d.tensors.erase(name); },
                          fmt::format("tensor '{}' is missing", name));
  expect_refusal_of_own([](SafetensorsDraft& d) { d.tensors.erase("agent1.fc3.weight"); },
                        "a network of 4 outputs: expected 2, an action");
  expect_refusal_of_own([](SafetensorsDraft& d) { d.put("extra", {1}); }, "tensor 'extra' has no place in a policy");
  expect_refusal_of_own([](SafetensorsDraft& d) { d.put("agent0.fc5.bias", {1}); },
                        "tensor 'agent0.fc5.bias' has no place");
  expect_refusal_of_own([](SafetensorsDraft& d) { d.put("in_fn.weight", {16}); }, "tensor 'in_fn.weight' has no place");
  for (const char* name : {"in_fn.bias", "in_fn.running_mean", "in_fn.running_var", "fc1.bias", "fc1.weight"})
    expect_refusal_of_published([&](SafetensorsDraft& d) { d.tensors.erase(name); },
                                fmt::format("tensor '{}' is missing", name));
  expect_refusal_of_published([](SafetensorsDraft& d) { d.tensors.erase("in_fn.weight"); },
                              "tensor 'in_fn.bias' has no place");
  expect_refusal_of_published([](SafetensorsDraft& d) { d.put("agent0.fc1.weight", {1}); },
                              "tensor 'agent0.fc1.weight' has no");
}

TEST(PolicyRefusal, OfOtherShapes) {
  expect_refusal_of_own([](SafetensorsDraft& d) { d.put("agent0.fc1.bias", {5}); },
                        "tensor 'agent0.fc1.bias' has shape (5): expected (4)");
  expect_refusal_of_own(
      [](SafetensorsDraft& d) {
        d.put("agent0.fc1.bias", {4, 1});
      },
      "tensor 'agent0.fc1.bias' has shape (4, 1): expected (4)");
  expect_refusal_of_own(
      [](SafetensorsDraft& d) {
        d.put("agent0.fc2.weight", {4, 5});
      },
      "tensor 'agent0.fc2.weight' has shape (4, 5), which does not follow the layer before");
  expect_refusal_of_own([](SafetensorsDraft& d) { d.put("agent0.fc1.weight", {64}); },
                        "tensor 'agent0.fc1.weight' has shape (64)");
  expect_refusal_of_own(
      [](SafetensorsDraft& d) {
        d.put("agent0.fc1.weight", {0, 16});
      },
      "tensor 'agent0.fc1.weight' has shape (0");
  expect_refusal_of_own(
      [](SafetensorsDraft& d) {
        d.put("agent0.fc1.weight", {4, 0});
      },
      "tensor 'agent0.fc1.weight' has shape (4, 0");
  expect_refusal_of_own(
      [](SafetensorsDraft& d) {
        d.put("agent0.fc1.weight", {4097, 16});
      },
      "tensor 'agent0.fc1.weight' has shape");
  expect_refusal_of_own(
      [](SafetensorsDraft& d) {
        for (const std::uint64_t layer : {3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17}) {
          d.put(fmt::format("agent0.fc{}.weight", layer), {4, 4});
          d.put(fmt::format("agent0.fc{}.bias", layer), {4});
        }
      },
      "more than 16 layers");
  // A shape may promise more than there is, or than there can be.
  expect_refusal_of_own([](SafetensorsDraft& d) { d.tensors["agent0.fc1.weight"].data.resize(60); },
                        "tensor 'agent0.fc1.weight' has 60 bytes: expected 256");
  expect_refusal_of_own(
      [](SafetensorsDraft& d) {
        d.tensors["agent0.fc1.weight"].shape = {std::numeric_limits<std::uint64_t>::max(), 16};
      },
      "tensor 'agent0.fc1.weight' has shape (18446744073709551615, 16)");
  expect_refusal_of_published([](SafetensorsDraft& d) { d.put("in_fn.running_mean", {15}); },
                              "tensor 'in_fn.running_mean' has shape (15): expected (14)");
}

TEST(PolicyRefusal, OfOtherTypes) {
  expect_refusal_of_own([](SafetensorsDraft& d) { d.tensors["agent1.fc2.weight"].dtype = "F64"; },
                        "tensor 'agent1.fc2.weight' has type F64: expected F32; convert it");
  expect_refusal_of_published([](SafetensorsDraft& d) { d.tensors["in_fn.running_var"].dtype = "BF16"; },
                              "tensor 'in_fn.running_var' has type BF16: expected F32");
}

TEST(PolicyRefusal, OfNumbersThatAreNotFinite) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                          -std::numeric_limits<float>::infinity()}) {
    for (const char* name : {"agent0.fc1.weight", "agent2.fc3.bias"})
      expect_refusal_of_own([&](SafetensorsDraft& d) { d.set_number(name, 1, bad); },
                            fmt::format("tensor '{}' holds a number that is not finite", name));
    for (const char* name : {"in_fn.weight", "in_fn.bias", "in_fn.running_mean", "in_fn.running_var", "fc2.weight"})
      expect_refusal_of_published([&](SafetensorsDraft& d) { d.set_number(name, 1, bad); },
                                  fmt::format("tensor '{}' holds a number that is not finite", name));
  }
  expect_refusal_of_published([](SafetensorsDraft& d) { d.set_number("in_fn.running_var", 13, -1e-9F); },
                              "tensor 'in_fn.running_var' holds a number below 0");
}

TEST(PolicyRefusal, OfOtherWidths) {
  for (const std::uint64_t width : {1, 13, 15, 23, 25})
    expect_refusal_of_published(
        [&](SafetensorsDraft& d) {
          for (const char* name : {"in_fn.weight", "in_fn.bias", "in_fn.running_mean", "in_fn.running_var"})
            d.put(name, {width});
          d.put("fc1.weight", {3, width});
        },
        fmt::format("a network of {} inputs: no agent of simple_tag or simple_world observes so many", width));
  expect_refusal_of_published(
      [](SafetensorsDraft& d) {
        d.put("fc2.weight", {3, 3}), d.put("fc2.bias", {3});
      },
      "a network of 3 outputs: expected 2, an action");
  expect_refusal_of_own(
      [](SafetensorsDraft& d) {
        d.put("agent1.fc1.weight", {4, 14});
      },
      "agent1 has 14 inputs: the predators of simple_tag observe 16 numbers");
  expect_refusal_of_own([](SafetensorsDraft& d) { d.metadata["side"] = "prey"; },
                        "agent0 has 16 inputs: the prey of simple_tag observe 14 numbers");
  expect_refusal_of_own([](SafetensorsDraft& d) { d.metadata["scenario"] = "simple_world"; },
                        "agent0 has 16 inputs: the predators of simple_world observe 24 numbers");
}

TEST(PolicyRefusal, OfOtherCounts) {
  expect_refusal_of_own(
      [](SafetensorsDraft& d) {
        for (const char* layer : {"fc1", "fc2", "fc3"})
          for (const char* part : {"weight", "bias"}) d.tensors.erase(fmt::format("agent2.{}.{}", layer, part));
      },
      "2 networks: expected 1 or 3");
  expect_refusal_of_own(
      [](SafetensorsDraft& d) {
        for (const char* layer : {"fc1", "fc2", "fc3"})
          for (const char* part : {"weight", "bias"}) {
            const auto tensor = d.tensors[fmt::format("agent2.{}.{}", layer, part)];
            d.tensors[fmt::format("agent3.{}.{}", layer, part)] = tensor;
          }
      },
      "4 networks: expected 1 or 3");
  auto prey = untrained_policy(Scenario::named("simple_tag"), Side::prey, 1, 4);
  auto draft = SafetensorsDraft::of(policy_bytes(prey));
  for (const auto& [name, tensor] : SafetensorsDraft(draft).tensors) draft.tensors["agent1" + name.substr(6)] = tensor;
  expect_file_refusal(draft, "2 networks: expected 1");
}

TEST(PolicyRefusal, OfOtherMetadata) {
  for (const char* key : {"scenario", "side", "squash"})
    expect_refusal_of_own([&](SafetensorsDraft& d) { d.metadata.erase(key); },
                          fmt::format("metadata '{}' is missing", key));
  expect_refusal_of_own([](SafetensorsDraft& d) { d.metadata["format"] = "folk-mpe-2"; },
                        "format 'folk-mpe-2': this Folk reads folk-mpe-1");
  expect_refusal_of_own([](SafetensorsDraft& d) { d.metadata["scenario"] = "simple\nspread"; },
                        "scenario 'simple?spread': expected simple_tag or simple_world");
  expect_refusal_of_own([](SafetensorsDraft& d) { d.metadata["side"] = "both"; },
                        "side 'both': expected predators or prey");
  expect_refusal_of_own([](SafetensorsDraft& d) { d.metadata["squash"] = "none"; },
                        "squash 'none': expected tanh or clamp");
  // Without its format it is taken for the published form.
  expect_refusal_of_own([](SafetensorsDraft& d) { d.metadata.erase("format"); }, "tensor 'fc1.weight' is missing");
}

TEST(PolicyRefusal, OfNormalisationsThatAreNone) {
  for (const char* name : {"agent1.norm.bias", "agent1.norm.mean", "agent1.norm.variance"})
    expect_refusal_of_normalising([&](SafetensorsDraft& d) { d.tensors.erase(name); },
                                  fmt::format("tensor '{}' is missing", name));
  expect_refusal_of_normalising([](SafetensorsDraft& d) { d.tensors.erase("agent1.norm.weight"); },
                                "tensor 'agent1.norm.bias' has no place");
  expect_refusal_of_own([](SafetensorsDraft& d) { d.put("agent0.norm.bias", {16}); },
                        "tensor 'agent0.norm.bias' has no place");
  expect_refusal_of_own([](SafetensorsDraft& d) { d.put("agent3.norm.weight", {16}); },
                        "tensor 'agent3.norm.weight' has no place");
  expect_refusal_of_own([](SafetensorsDraft& d) { d.put("norm.weight", {16}); }, "tensor 'norm.weight' has no place");
  for (const char* part : {"weight", "bias", "mean", "variance"}) {
    const std::string name = fmt::format("agent1.norm.{}", part);
    expect_refusal_of_normalising([&](SafetensorsDraft& d) { d.put(name, {15}); },
                                  fmt::format("tensor '{}' has shape (15): expected (16)", name));
    expect_refusal_of_normalising(
        [&](SafetensorsDraft& d) {
          d.put(name, {1, 16});
        },
        fmt::format("tensor '{}' has shape (1, 16): expected (16)", name));
    expect_refusal_of_normalising([&](SafetensorsDraft& d) { d.tensors[name].dtype = "F16"; },
                                  fmt::format("tensor '{}' has type F16: expected F32", name));
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()})
      expect_refusal_of_normalising([&](SafetensorsDraft& d) { d.set_number(name, 15, bad); },
                                    fmt::format("tensor '{}' holds a number that is not finite", name));
  }
  expect_refusal_of_normalising([](SafetensorsDraft& d) { d.set_number("agent1.norm.variance", 15, -1e-9F); },
                                "tensor 'agent1.norm.variance' holds a number below 0");
  // Other widths are told by the network, whose they are.
  expect_refusal_of_normalising([](SafetensorsDraft& d) { d.metadata["scenario"] = "simple_world"; },
                                "agent0 has 16 inputs");
}

// ---- what cannot be written --------------------------------------------------------------------------------------

TEST(PolicyToWrite, MustBeOneThatCanBeRead) {
  const auto refuse = [](const std::function<void(Policy&)>& change, const std::string& part) {
    auto policy = predators_of_tag();
    change(policy);
    expect_error<UsageError>([&] { policy_bytes(policy); }, part);
  };
  refuse([](Policy& p) { p.networks.clear(); }, "a policy without networks");
  refuse([](Policy& p) { p.networks[2].squash = Squash::clamp; }, "two kinds of actions");
  refuse([](Policy& p) { p.networks[1].parameters[3] = NAN; }, "not finite");
  refuse([](Policy& p) { p.networks[1].parameters[3] = -INFINITY; }, "not finite");
  const std::string again = "a policy that could not be read again: policy: ";
  refuse([](Policy& p) { p.scenario = "simple_spread"; }, again + "scenario 'simple_spread'");
  refuse([](Policy& p) { p.side = Side::prey; }, again + "agent0 has 16 inputs");
  refuse([](Policy& p) { p.networks.pop_back(); }, again + "2 networks");
  refuse([](Policy& p) { p.networks[0].parameters.pop_back(); }, again + "truncated");
  refuse([](Policy& p) { p.networks[0].parameters.push_back(0); }, again + "4 bytes too many");
  refuse([](Policy& p) { p.networks[1].normalisation.emplace(); }, again + "truncated");
  const auto refuse_normalisation = [&](const std::function<void(InputNormalisation&)>& change,
                                        const std::string& part) {
    refuse(
        [&](Policy& p) {
          p.networks[1].normalisation = some_normalisation(16);
          change(*p.networks[1].normalisation);
        },
        part);
  };
  refuse_normalisation([](auto& n) { n.epsilon = 1e-3; }, "an epsilon of 0.001");
  refuse_normalisation([](auto& n) { n.variance[2] = -1; },
                       again + "tensor 'agent1.norm.variance' holds a number below");
  refuse_normalisation([](auto& n) { n.mean[2] = NAN; }, "not finite");
  refuse_normalisation([](auto& n) { n.bias.push_back(1); }, again + "4 bytes too many");
}

TEST(PolicyToWrite, LeavesTheFileThereWasWhenItCannot) {
  const testing::TemporaryFolder folder;
  const auto path = folder.path() / "policy";
  write_policy(path, predators_of_tag());
  auto bad = predators_of_tag();
  bad.networks[0].parameters[0] = NAN;
  expect_error<UsageError>([&] { write_policy(path, bad); }, "not finite");
  expect_same(read_policy(path), predators_of_tag());
}

// ---- who plays ---------------------------------------------------------------------------------------------------

TEST(PolicyController, IsForOneSideAndScenario) {
  const auto tag = Scenario::named("simple_tag");
  expect_error<UsageError>([&] { policy_controller("p", predators_of_tag(), Side::prey, tag); },
                           "p: a policy of the predators, not of the prey");
  expect_error<UsageError>(
      [&] { policy_controller("p", predators_of_tag(), Side::predators, Scenario::named("simple_world")); },
      "p: a policy for simple_tag, not for simple_world");
  // A scenario of the same name with more in it.
  auto larger = tag;
  larger.entities.insert(larger.entities.begin(), larger.entities.front());
  const auto player = policy_controller("p", predators_of_tag(), Side::predators, larger);
  expect_error<UsageError>([&] { player.player(Layout(larger), 0); }, "p: has no network for agent 0, who observes 18");
  expect_error<UsageError>([&] { player.player(Layout(larger), 3); }, "p: has no network for agent 0, who observes 18");
  expect_error<UsageError>(
      [&] {
        policy_controller("p", Policy{"simple_tag", Side::predators, {}, {}}, Side::predators, tag)
            .player(Layout(tag), 0);
      },
      "p: has no network for agent 0");
}

/// The actions of the agents in an episode's first step.
std::vector<Point> first_actions(const Controller& controller) {
  const Layout layout(Scenario::named("simple_tag"));
  Batch batch(layout.scenario(), 1);
  batch.reset(4);
  // All predators see the same.
  auto state = batch.state(0);
  for (std::size_t i = 1; i < 3; ++i) state.positions[i] = state.positions[0];
  batch.set_state(0, state);
  std::vector<Point> actions;
  for (std::size_t agent = 0; agent < 3; ++agent) {
    const Block block = batch.block(0);
    controller.player(layout, agent)->act(layout, block, agent, {});
    const auto [x, y] = action_rows(block, agent);
    actions.push_back({*x, *y});
  }
  return actions;
}

TEST(PolicyController, GivesEachAgentItsNetwork) {
  const auto tag = Scenario::named("simple_tag");
  const auto own = first_actions(policy_controller("p", predators_of_tag(), Side::predators, tag));
  EXPECT_NE(own[0], own[1]);
  EXPECT_NE(own[1], own[2]);
  for (std::size_t agent = 0; agent < 3; ++agent) {
    auto shared = predators_of_tag();
    shared.networks = {shared.networks[agent]};
    EXPECT_EQ(first_actions(policy_controller("p", shared, Side::predators, tag)), std::vector<Point>(3, own[agent]));
  }
}

TEST(UntrainedPolicy, HasANetworkForEachAgentFromItsSeed) {
  const auto world = Scenario::named("simple_world");
  const auto predators = untrained_policy(world, Side::predators, 5);
  ASSERT_EQ(predators.networks.size(), 3U);
  EXPECT_EQ(predators.networks[2].shape, MlpShape({24, 64, 64, 2}));
  EXPECT_NE(predators.networks[0].parameters, predators.networks[1].parameters);
  expect_same(predators, untrained_policy(world, Side::predators, 5));
  EXPECT_NE(predators.networks[0].parameters, untrained_policy(world, Side::predators, 6).networks[0].parameters);
  const auto prey = untrained_policy(world, Side::prey, 5);
  ASSERT_EQ(prey.networks.size(), 1U);
  EXPECT_EQ(prey.networks[0].shape, MlpShape({22, 64, 64, 2}));
  EXPECT_EQ(to_string(prey.side), "prey");
  EXPECT_EQ(to_string(predators.side), "predators");
}

}  // namespace
}  // namespace folk::mpe
