// Transformers of the particle world as files, and what is refused of them.

#include <folk/mpe/players/transformer_policy.h>
#include <folk/sct/network/network_file.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "games/expect_error.h"
#include "mpe/players/safetensors_draft.h"
#include "mpe/players/small_transformer.h"

namespace folk::mpe {
namespace {

using folk::test::expect_error;
using testing::SafetensorsDraft;
using testing::small_transformer;

void expect_same(const TransformerPolicy& one, const TransformerPolicy& other) {
  EXPECT_EQ(one.scenario, other.scenario);
  EXPECT_EQ(one.architecture, other.architecture);
  EXPECT_EQ(one.mode, other.mode);
  EXPECT_EQ(one.parameters, other.parameters);
  EXPECT_EQ(one.scale, other.scale);
  EXPECT_EQ(one.return_scale, other.return_scale);
  EXPECT_EQ(one.return_target, other.return_target);
  EXPECT_EQ(one.notes, other.notes);
}

TEST(TransformerPolicy, IsReadAsItWasWritten) {
  std::uint64_t seed = 0;
  for (const auto& kind : testing::transformer_kinds)
    for (const char* scenario : {"simple_tag", "simple_world"}) {
      auto policy = small_transformer(kind, scenario, {.context = 1 + seed % 25, .layers = 1 + seed % 3}, seed + 1);
      ++seed;
      policy.scale.mean = {1.0F / 3, -0.0F, 1e-30F};
      policy.scale.deviation = {1e-6F, 0.1F, 3e8F};
      policy.return_scale = 1.0 / 3;
      policy.return_target = -185.6;
      policy.notes = {{"made by", "a \"test\", \xC3\xA9"}, {"steps", "7"}};
      const auto bytes = transformer_policy_bytes(policy);
      const auto again = parse_transformer_policy(bytes, "policy");
      expect_same(again, policy);
      EXPECT_EQ(transformer_policy_bytes(again), bytes);
    }
}

TEST(TransformerPolicy, IsAsItsHeaderDescribesIt) {
  const auto policy = small_transformer({"teacher_cat"}, "simple_world");
  const auto draft = SafetensorsDraft::of(transformer_policy_bytes(policy));
  const std::map<std::string, std::string> expected{
      {"format", "folk-mpe-transformer-1"},
      {"scenario", "simple_world"},
      {"loss_mode", "teacher"},
      {"scale_mean", "0.1 -0.2 0.05"},
      {"scale_deviation", "0.9 1.1 1.3"},
      {"return_scale", "10"},
      {"return_target", "12.5"},
      {"hidden", "16"},
      {"layers", "2"},
      {"heads", "2"},
      {"context", "20"},
      {"time_rows", "26"},
      {"observation_size", "24"},
      {"action_size", "2"},
      {"agents", "3"},
      {"discrete", "false"},
      {"readout", "cat"},
      {"belief_token", "true"},
      {"auxiliary", "false"},
      {"token_layout", "return observation.0 observation.1 observation.2 belief action.0 action.1 action.2"},
      {"observation", "numbers"},
      {"made by", "a test"},
      {"checksum", draft.metadata.at("checksum")}};
  EXPECT_EQ(draft.metadata, expected);
  EXPECT_EQ(draft.tensors.size(), sct::ParameterLayout(policy.architecture).tensors().size());
  EXPECT_EQ(draft.tensors.at("embed_timestep.weight").shape, (std::vector<std::uint64_t>{26, 16}));
  EXPECT_EQ(draft.tensors.at("predict_curact.2.weight").shape, (std::vector<std::uint64_t>{2, 16}));
  EXPECT_EQ(draft.tensors.at("opo_obs_cat.weight").shape, (std::vector<std::uint64_t>{16, 32}));
  float number = 0;
  std::memcpy(&number, draft.tensors.at("predict_opoact.bias").data.data() + sizeof number, sizeof number);
  EXPECT_EQ(number, policy.parameters[sct::ParameterLayout(policy.architecture)["predict_opoact.bias"].offset + 1]);
}

TEST(TransformerPolicy, MayBeStoredByOthersInAnotherOrder) {
  const auto policy = small_transformer();
  const auto bytes = transformer_policy_bytes(policy);
  const auto other = SafetensorsDraft::of(bytes).bytes();  // tensors by name
  EXPECT_NE(other, bytes);
  expect_same(parse_transformer_policy(other, "p"), policy);
}

TEST(TransformerPolicy, HasTheStreamOfItsScenario) {
  sct::Architecture base;
  base.hidden = 4;
  base.readout = sct::Readout::add;
  const auto tag = particle_architecture(Scenario::named("simple_tag"), base);
  EXPECT_EQ(tag.agents, 3U);
  EXPECT_EQ(tag.observation_size, 16U);
  EXPECT_EQ(tag.action_size, 2U);
  EXPECT_FALSE(tag.discrete);
  EXPECT_EQ(tag.time_rows, 26U);
  EXPECT_EQ(tag.hidden, 4U);
  EXPECT_EQ(tag.readout, sct::Readout::add);
  EXPECT_EQ(tag.round_tokens(), 8U);
  EXPECT_EQ(particle_architecture(Scenario::named("simple_world")).observation_size, 24U);
}

// ---- refusals ----------------------------------------------------------------------------------------------------

using Change = std::function<void(SafetensorsDraft&)>;

/// What is said of a file after a change, for which the checksum is mended.
void expect_transformer_refusal(const Change& change, const std::string& part) {
  const auto policy = small_transformer();
  auto draft = SafetensorsDraft::of(transformer_policy_bytes(policy));
  parse_transformer_policy(draft.bytes(), "unchanged");
  change(draft);
  if (draft.metadata.contains("checksum"))
    draft.metadata["checksum"] = sct::checksum(draft.metadata, policy.parameters);
  expect_error<InputFileError>([&] { parse_transformer_policy(draft.bytes(), "p\nq"); }, "p?q: " + part);
}

TEST(TransformerPolicyRefusal, OfWhatIsNoSuchFile) {
  for (const std::string bytes : {"", "x", "no policy at all"})
    expect_error<InputFileError>([&] { parse_transformer_policy(bytes, "p\nq"); }, "p?q: ");
  const auto whole = transformer_policy_bytes(small_transformer());
  expect_error<InputFileError>([&] { parse_transformer_policy(whole + "1234", "p"); }, "p: 4 bytes too many");
}

TEST(TransformerPolicyRefusal, OfEveryTruncation) {
  const auto whole = transformer_policy_bytes(
      small_transformer({"madt", sct::LossMode::action_only, sct::Readout::own, false}, "simple_tag", {1, 1, 1, 1}));
  for (std::size_t size = 0; size < whole.size(); ++size)
    expect_error<InputFileError>([&] { parse_transformer_policy(std::string_view(whole).substr(0, size), "p"); },
                                 "p: ");
}

TEST(TransformerPolicyRefusal, OfMetadataThatAreMissing) {
  const auto draft = SafetensorsDraft::of(transformer_policy_bytes(small_transformer()));
  for (const auto& [key, text] : draft.metadata) {
    if (key == "made by") continue;
    expect_transformer_refusal([&, key = key](SafetensorsDraft& d) { d.metadata.erase(key); },
                               fmt::format("metadata lacks '{}'", key));
  }
}

TEST(TransformerPolicyRefusal, OfOtherMetadata) {
  const auto refused = [](const char* key, const char* value, const std::string& part) {
    expect_transformer_refusal([&](SafetensorsDraft& d) { d.metadata[key] = value; }, part);
  };
  const auto wrong = [&](const char* key, const char* value, const std::string& expected) {
    refused(key, value, fmt::format("metadata '{}' is '{}': expected {}", key, value, expected));
  };
  refused("format", "folk-mpe-1", "format 'folk-mpe-1': this Folk reads folk-mpe-transformer-1");
  refused("format", "", "format ''");
  refused("scenario", "simple\nspread", "scenario 'simple?spread': expected simple_tag or simple_world");
  refused("scenario", "simple_world", "its stream is not that of simple_world");
  refused("loss_mode", "guess", "'guess' is no loss mode: expected teacher, selfconf");
  for (const char* key :
       {"hidden", "layers", "heads", "context", "time_rows", "observation_size", "action_size", "agents"})
    for (const char* value : {"", "-1", "1.5", "x", "16 ", " 16", "+16", "99999999999999999999999"})
      wrong(key, value, "a whole number");
  for (const char* key :
       {"hidden", "layers", "heads", "context", "time_rows", "observation_size", "action_size", "agents"})
    for (const char* value : {"0", "18446744073709551615"})
      refused(key, value, fmt::format("{} = {}: expected", key, value));
  for (const char* key : {"discrete", "belief_token", "auxiliary"})
    for (const char* value : {"", "1", "True", "yes"}) wrong(key, value, "true or false");
  wrong("readout", "none", "token, cat, add or own");
  wrong("token_layout", "return observation action", "return observation.0");
  wrong("observation", "start CC CD DC DD", "numbers");
  refused("heads", "3", "hidden = 16 is not divided by heads = 3");
  refused("belief_token", "false", "readout cat reads the belief token");
  for (const char* value : {"", "0.1 -0.2", "0.1 -0.2 0.05 1", "0.1  -0.2 0.05", "0.1,-0.2,0.05", "a b c",
                            "0.1 nan 0.05", "inf 0 0", "1e39 0 0", " 0.1 -0.2 0.05", "0.1 -0.2 0.05 "}) {
    wrong("scale_mean", value, "3 numbers");
    wrong("scale_deviation", value, "3 numbers");
  }
  for (const char* value : {"1 0 1", "1 1 -1"}) wrong("scale_deviation", value, "numbers above 0");
  for (const char* key : {"return_scale", "return_target"}) {
    for (const char* value : {"", "x", "1 ", "1e999"}) wrong(key, value, "a decimal number");
    for (const char* value : {"inf", "nan", "-inf"}) wrong(key, value, "a finite number");
  }
  for (const char* value : {"0", "-1"}) wrong("return_scale", value, "a number above 0");
}

TEST(TransformerPolicyRefusal, OfAnotherStream) {
  const auto other = [](const std::function<void(sct::Architecture&)>& change) {
    auto policy = small_transformer();
    change(policy.architecture);
    policy.parameters.assign(sct::ParameterLayout(policy.architecture).size(), 0.5F);
    expect_error<UsageError>([&] { transformer_policy_bytes(policy); }, "its stream is not that of simple_tag");
  };
  other([](auto& a) { a.agents = 2; });
  other([](auto& a) { a.observation_size = 24; });
  other([](auto& a) { a.time_rows = 25; });
  other([](auto& a) { a.action_size = 3; });
  other([](auto& a) { a.discrete = true; });
}

TEST(TransformerPolicyRefusal, OfTensorsThatDoNotFit) {
  for (const char* name : {"embed_timestep.weight", "h.1.mlp.c_proj.bias", "predict_curact.2.weight", "ln_f.bias"})
    expect_transformer_refusal([&](SafetensorsDraft& d) { d.tensors.erase(name); },
                               fmt::format("lacks tensor '{}'", name));
  expect_transformer_refusal(
      [](SafetensorsDraft& d) {
        d.put("wte.weight", {1, 16});
      },
      "tensor 'wte.weight' is not of its architecture");
  expect_transformer_refusal(
      [](SafetensorsDraft& d) {
        d.put("embed_return.weight", {1, 16});
      },
      "tensor 'embed_return.weight' has shape [1, 16], but the architecture asks for [16, 1]");
  expect_transformer_refusal([](SafetensorsDraft& d) { d.put("h.0.ln_1.bias", {15}); },
                             "tensor 'h.0.ln_1.bias' has shape [15], but the architecture asks for [16]");
  expect_transformer_refusal([](SafetensorsDraft& d) { d.tensors.at("ln_f.bias").dtype = "F16"; },
                             "tensor 'ln_f.bias' has dtype F16; store it as F32");
  expect_transformer_refusal([](SafetensorsDraft& d) { d.tensors.at("ln_f.bias").data.resize(60); },
                             "tensor 'ln_f.bias' has 60 bytes, but its shape asks for 64");
  expect_transformer_refusal([](SafetensorsDraft& d) { d.metadata["layers"] = "3"; }, "lacks tensor 'h.2.ln_1.weight'");
  expect_transformer_refusal([](SafetensorsDraft& d) { d.metadata["hidden"] = "32"; },
                             "tensor 'embed_timestep.weight' has shape");
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::infinity()})
    expect_transformer_refusal([&](SafetensorsDraft& d) { d.set_number("h.1.attn.c_attn.weight", 50, bad); },
                               fmt::format("tensor 'h.1.attn.c_attn.weight' holds {} at [1, 2]", bad));
}

TEST(TransformerPolicyRefusal, OfContentsThatWereChanged) {
  const auto whole = transformer_policy_bytes(small_transformer());
  const auto changed = [&](const Change& change) {
    auto draft = SafetensorsDraft::of(whole);
    change(draft);
    expect_error<InputFileError>([&] { parse_transformer_policy(draft.bytes(), "p"); },
                                 "the contents were changed; take a fresh copy");
  };
  changed([](SafetensorsDraft& d) { d.set_number("ln_f.bias", 3, 0.25F); });
  changed([](SafetensorsDraft& d) { d.metadata["context"] = "19"; });
  changed([](SafetensorsDraft& d) { d.metadata["heads"] = "4"; });
  changed([](SafetensorsDraft& d) { d.metadata["loss_mode"] = "selfconf"; });
  changed([](SafetensorsDraft& d) { d.metadata["return_target"] = "12.6"; });
  changed([](SafetensorsDraft& d) { d.metadata["scale_mean"] = "0.1 -0.2 0.06"; });
  changed([](SafetensorsDraft& d) { d.metadata["made by"] = "somebody else"; });
  changed([](SafetensorsDraft& d) { d.metadata["new"] = "note"; });
  changed([](SafetensorsDraft& d) { d.metadata.erase("made by"); });
  changed([](SafetensorsDraft& d) { d.metadata["checksum"] = "0123456789abcdef"; });
  changed([](SafetensorsDraft& d) { d.metadata["checksum"] = ""; });
}

TEST(TransformerPolicyRefusal, OfWritingWhatCouldNotBeRead) {
  const auto refused = [](const std::function<void(TransformerPolicy&)>& change, const std::string& part) {
    auto policy = small_transformer();
    change(policy);
    expect_error<UsageError>([&] { transformer_policy_bytes(policy); }, part);
  };
  refused([](auto& p) { p.scenario = "simple_world"; }, "its stream is not that of simple_world");
  refused([](auto& p) { p.scenario = "chess"; }, "chess");
  refused([](auto& p) { p.parameters.pop_back(); }, "parameters: the architecture has");
  refused([](auto& p) { p.parameters[3] = NAN; }, "holds nan");
  refused([](auto& p) { p.architecture.heads = 3; }, "is not divided by heads = 3");
  refused([](auto& p) { p.scale.mean.pop_back(); }, "scale_mean");
  refused([](auto& p) { p.scale.deviation[1] = 0; }, "scale_deviation");
  refused([](auto& p) { p.scale.mean[1] = NAN; }, "scale_mean");
  refused([](auto& p) { p.return_scale = 0; }, "return_scale");
  refused([](auto& p) { p.return_target = INFINITY; }, "return_target");
}

/// A return beyond what a network can be told.
TEST(TransformerPolicyRefusal, OfAReturnThatNoFloatHolds) {
  auto policy = small_transformer();
  policy.return_target = 1e300;
  expect_error<UsageError>([&] { transformer_policy_bytes(policy); }, "return_target");
  policy.return_target = 1;
  policy.return_scale = 1e-300;
  expect_error<UsageError>([&] { transformer_policy_bytes(policy); }, "return_target");
}

/// Notes say how a policy was made, not what it is.
TEST(TransformerPolicyRefusal, OfNothingThatNotesSay) {
  auto policy = small_transformer();
  policy.notes = {{"hidden", "1"}, {"checksum", "0"}, {"format", "x"}};
  const auto again = parse_transformer_policy(transformer_policy_bytes(policy), "p");
  EXPECT_EQ(again.architecture, policy.architecture);
  EXPECT_TRUE(again.notes.empty());
}

}  // namespace
}  // namespace folk::mpe
