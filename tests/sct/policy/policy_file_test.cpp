#include <folk/games/error.h>
#include <folk/games/text_file.h>
#include <folk/sct/network/network_file.h>
#include <folk/sct/policy/policy_file.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "games/expect_error.h"
#include "sct/policy/small_policy.h"

namespace folk::sct {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using test::expect_error;

const std::string& small_bytes() {
  static const std::string bytes = policy_bytes(test::small_policy());
  return bytes;
}

/// A policy file taken apart.
struct Parts {
  std::string header;
  std::string data;

  Json json() const { return Json::parse(header); }
};

Parts parts(const std::string& bytes = small_bytes()) {
  std::size_t length = 0;
  for (std::size_t i = 0; i < 8; ++i) length |= std::size_t{static_cast<unsigned char>(bytes[i])} << (8 * i);
  return {bytes.substr(8, length), bytes.substr(8 + length)};
}

std::string put_together(const std::string& header, const std::string& data) {
  std::string bytes;
  for (std::size_t i = 0; i < 8; ++i) bytes += static_cast<char>((header.size() >> (8 * i)) & 0xFFU);
  return bytes + header + data;
}

void expect_refusal(const std::string& bytes, const std::string& part) {
  expect_error<InputFileError>([&] { parse_policy(bytes, "p.bin"); }, "p.bin: " + part);
}

/// Expects the small policy's file to be refused after `change` to its header.
void expect_header_refusal(const std::function<void(Json&)>& change, const std::string& part) {
  Json header = parts().json();
  change(header);
  expect_refusal(put_together(header.dump(), parts().data), part);
}

void expect_metadata_refusal(const std::string& key, const std::string& value, const std::string& part) {
  expect_header_refusal([&](Json& header) { header["__metadata__"][key] = value; }, part);
}

void expect_text_refusal(const std::string& header, const std::string& part) {
  expect_refusal(put_together(header, ""), part);
}

/// Replaces the first `old` of the small policy's header.
std::string replaced(const std::string& old, const std::string& by) {
  std::string header = parts().header;
  header.replace(header.find(old), old.size(), by);
  return put_together(header, parts().data);
}

TEST(PolicyFile, KeepsEverything) {
  for (const Policy& policy : {test::small_policy(), test::continuous_policy()}) {
    const Policy back = parse_policy(policy_bytes(policy), "p.bin");
    EXPECT_EQ(back.architecture, policy.architecture);
    EXPECT_EQ(back.parameters, policy.parameters);
    EXPECT_EQ(back.action_names, policy.action_names);
    EXPECT_EQ(back.training.mode, policy.training.mode);
    EXPECT_EQ(back.training.roster, policy.training.roster);
    EXPECT_EQ(back.training.payoffs, policy.training.payoffs);
    EXPECT_EQ(policy_bytes(back), policy_bytes(policy));
  }
}

// A planner that an older Folk let play by its action head would be another player: the format says so.
TEST(PolicyFile, KeepsHowItPlays) {
  for (const auto& [shows_return, depth] : {std::pair{true, 4U}, {false, 0U}, {false, 10U}}) {
    Policy policy = test::small_policy();
    policy.training.shows_return = shows_return;
    policy.training.plan_depth = depth;
    const auto bytes = policy_bytes(policy);
    EXPECT_NE(bytes.find("folk-sct-2"), std::string::npos);
    const Policy back = parse_policy(bytes, "p.bin");
    EXPECT_EQ(back.training.shows_return, shows_return);
    EXPECT_EQ(back.training.plan_depth, depth);
    EXPECT_EQ(policy_bytes(back), bytes);
  }
  EXPECT_EQ(policy_bytes(test::small_policy()).find("folk-sct-2"), std::string::npos);
  Policy policy = test::small_policy();
  policy.training.plan_depth = 11;
  test::expect_error<UsageError>([&] { policy_bytes(policy); }, "plan_depth = 11: expected at most 10");
}

TEST(PolicyFile, RefusesToPlayOtherwise) {
  Policy policy = test::small_policy();
  policy.training.shows_return = false;
  policy.training.plan_depth = 4;
  const auto bytes = policy_bytes(policy);
  const auto refuses = [&](const std::string& old, const std::string& by, const std::string& part) {
    auto other = bytes;
    ASSERT_NE(other.find(old), std::string::npos) << old;
    other.replace(other.find(old), old.size(), by);
    expect_refusal(other, part);
  };
  refuses(R"("return_token":"hidden")", R"("return_token":"hiddem")",
          "metadata 'return_token' is 'hiddem': expected shown or hidden");
  refuses(R"("plan_depth":"4")", R"("plan_depth":"x")", "metadata 'plan_depth' is 'x'");
  refuses("folk-sct-2", "folk-sct-3", "a policy in format 'folk-sct-3', but this Folk reads folk-sct-1 and folk-sct-2");
  refuses("folk-sct-2", "folk-sct-1", "checksum ");
}

TEST(PolicyFile, KeepsNumbersExactly) {
  Policy policy = test::small_policy();
  policy.parameters[0] = std::numeric_limits<float>::denorm_min();
  policy.parameters[1] = -0.0F;
  policy.parameters[2] = std::numeric_limits<float>::max();
  auto& t = policy.training;
  t.return_scale = 1.0 / 3;
  t.return_target = -1e-300;
  t.final_belief_loss = std::numeric_limits<double>::denorm_min();
  t.final_action_loss = 0.1 + 0.2;
  t.seed = t.steps = std::numeric_limits<std::uint64_t>::max();
  t.payoffs = {Rational(1) / 3, -2, parse_rational("12345678901234567890"), 4};  // no prisoner's dilemma
  const Policy back = parse_policy(policy_bytes(policy), "p.bin");
  EXPECT_EQ(back.parameters[0], policy.parameters[0]);
  EXPECT_TRUE(std::signbit(back.parameters[1]));
  EXPECT_EQ(back.parameters[2], policy.parameters[2]);
  EXPECT_EQ(back.training.return_scale, t.return_scale);
  EXPECT_EQ(back.training.return_target, t.return_target);
  EXPECT_EQ(back.training.final_belief_loss, t.final_belief_loss);
  EXPECT_EQ(back.training.final_action_loss, t.final_action_loss);
  EXPECT_EQ(back.training.seed, t.seed);
  EXPECT_EQ(back.training.steps, t.steps);
  EXPECT_EQ(back.training.payoffs, t.payoffs);
}

TEST(PolicyFile, KeepsAnyText) {
  Policy policy = test::small_policy();
  policy.action_names = {"stag, \"big\"", "h\xC3\xA4schen\n"};
  policy.training.roster = std::string("a\0b\\,\"'}", 8);
  policy.training.data = "not UTF-8: \xFF";
  const Policy back = parse_policy(policy_bytes(policy), "p.bin");
  EXPECT_EQ(back.action_names, policy.action_names);
  EXPECT_EQ(back.training.roster, policy.training.roster);
  EXPECT_EQ(back.training.data, "not UTF-8: \xEF\xBF\xBD");
  EXPECT_EQ(policy_bytes(back), policy_bytes(policy));
}

// The format is a promise: these bytes must be read, and written, by every later version.
TEST(PolicyFile, IsTheFormatOfTheShippedFiles) {
  const fs::path file = fs::path(FOLK_SOURCE_DIR) / "tests/fuzz/corpus/policy/smallest";
  EXPECT_EQ(read_file(file, 65536), small_bytes());
  EXPECT_EQ(policy_bytes(read_policy(file)), small_bytes());
}

TEST(PolicyFile, HoldsDataAtAMultipleOfEight) {
  for (std::size_t length = 0; length < 9; ++length) {
    Policy policy = test::small_policy();
    policy.training.roster = std::string(length, 'r');
    EXPECT_EQ(parts(policy_bytes(policy)).header.size() % 8, 0U);
  }
}

TEST(PolicyFile, ReadsTensorsInAnyOrder) {
  const Parts small = parts();
  const Json header = small.json();
  Json turned = Json::object();
  std::string data;
  for (auto entry = header.rbegin(); entry != header.rend(); ++entry) {
    turned[entry.key()] = entry.value();
    if (entry.key() == "__metadata__") continue;
    const std::size_t begin = entry.value()["data_offsets"][0];
    const std::size_t end = entry.value()["data_offsets"][1];
    turned[entry.key()]["data_offsets"] = {data.size(), data.size() + end - begin};
    data += small.data.substr(begin, end - begin);
  }
  EXPECT_EQ(policy_bytes(parse_policy(put_together(turned.dump(), data), "p.bin")), small_bytes());
}

TEST(PolicyFile, IsWrittenAtOnce) {
  std::string folder = (fs::temp_directory_path() / "folk-policy-XXXXXX").string();
  ASSERT_NE(mkdtemp(folder.data()), nullptr);
  const fs::path file = fs::path(folder) / "p.bin";
  write_policy(file, test::continuous_policy());
  write_policy(file, test::small_policy());
  EXPECT_EQ(policy_bytes(read_policy(file)), small_bytes());
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator{}), 1);
  expect_error<InputFileError>([&] { read_policy(fs::path(folder) / "q.bin"); }, "q.bin: no such file");
  expect_error<InputFileError>([&] { read_policy(folder); }, "is a directory");
  fs::resize_file(file, largest_policy_file + 1);  // sparse: takes no disk
  expect_error<InputFileError>([&] { read_policy(file); }, "p.bin: larger than 1024 MiB");
  fs::remove_all(folder);
}

TEST(PolicyFile, RefusesEveryTruncation) {
  for (std::size_t length = 0; length < small_bytes().size(); ++length)
    expect_refusal(small_bytes().substr(0, length), "");
  expect_refusal("", "an empty file");
  expect_refusal("short", "no safetensors file: only 5 bytes");
  expect_refusal(small_bytes().substr(0, 500), "ends within its header of ");
  expect_refusal(small_bytes().substr(0, small_bytes().size() - 1),
                 "truncated: tensor 'predict_curact.0.bias' ends at");
  expect_refusal(small_bytes() + 'x', "1 bytes too many at its end");
}

TEST(PolicyFile, RefusesFlippedBits) {
  for (std::size_t i = 0; i < small_bytes().size() * 8; i += 3) {  // all eight places, and quick under a sanitizer
    std::string bytes = small_bytes();
    bytes[i / 8] = static_cast<char>(bytes[i / 8] ^ (1 << (i % 8)));
    expect_refusal(bytes, "");
  }
  std::string bytes = small_bytes();
  bytes.back() = static_cast<char>(bytes.back() ^ 1);
  expect_refusal(bytes, "checksum ");
}

TEST(PolicyFile, RefusesWhatIsNoPolicy) {
  expect_refusal("NFG 1 R \"a game\"", "no safetensors file: no JSON header; check the name");
  expect_refusal("\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF{}", "no policy: a header of 18446744073709551615 bytes");
  expect_text_refusal("{}", "a safetensors file, but no policy of Folk");
  expect_text_refusal(R"({"__metadata__": {"format": "pt"}})", "a safetensors file, but no policy of Folk");
  expect_refusal(put_together(R"({"w": {"dtype": "BF16", "shape": [1], "data_offsets": [0, 2]}})", "ab"),
                 "a safetensors file, but no policy of Folk; name one that sct-train wrote");
  expect_metadata_refusal("format", "folk-sct-3", "a policy in format 'folk-sct-3', but this Folk reads folk-sct-1");
}

TEST(PolicyFile, RefusesADamagedHeader) {
  const std::string damaged = "damaged header: ";
  expect_text_refusal("{", damaged + "no JSON at its byte 2");
  expect_text_refusal(std::string("{}\0", 3), damaged + "a zero at its byte 3");
  expect_text_refusal("{} {}", damaged + "no JSON at its byte");
  expect_text_refusal("{\"\xFF\": {}}", damaged + "no JSON");
  expect_text_refusal(R"({"a": {"shape": [1e999]}})", damaged + "no JSON");
  expect_text_refusal(R"({"a": 1})", damaged + "'a' is a number instead of an object");
  expect_text_refusal(R"({"a": []})", damaged + "'a' is a list instead of an object");
  expect_text_refusal(R"({"a": null})", damaged + "'a' is null");
  expect_text_refusal(R"({"": {}})", damaged + "a tensor without a name");
  expect_text_refusal(R"({"a": {}, "a": {}})", damaged + "'a' is there twice");
  expect_text_refusal(R"({"__metadata__": {}, "__metadata__": {}})", damaged + "'__metadata__' is there twice");
  expect_text_refusal(R"({"__metadata__": {"k": "", "k": ""}})", damaged + "metadata 'k' is there twice");
  expect_text_refusal(R"({"__metadata__": {"k": 1}})", damaged + "'k' of '__metadata__' holds a number");
  expect_text_refusal(R"({"__metadata__": {"k": {}}})", damaged + "'k' of '__metadata__' holds an object");
  expect_text_refusal(R"({"a": {"type": 1}})", damaged + "tensor 'a' has an unknown 'type'");
  expect_text_refusal(R"({"a": {"shape": [], "shape": []}})", damaged + "tensor 'a' has 'shape' twice");
  expect_text_refusal(R"({"a": {"dtype": 5}})", damaged + "'dtype' of 'a' holds a number");
  expect_text_refusal(R"({"a": {"dtype": ["F32"]}})", damaged + "'dtype' of 'a' holds a list");
  expect_text_refusal(R"({"a": {"shape": "1"}})", damaged + "'shape' of 'a' holds a text");
  expect_text_refusal(R"({"a": {"shape": [[1]]}})", damaged + "'shape' of 'a' holds a list");
  expect_text_refusal(R"({"a": {"shape": [-1]}})", damaged + "'shape' of 'a' holds a negative number");
  expect_text_refusal(R"({"a": {"shape": [1.5]}})", damaged + "'shape' of 'a' holds a number that is not whole");
  expect_text_refusal(R"({"a": {"shape": [true]}})", damaged + "'shape' of 'a' holds a truth value");
  expect_text_refusal(R"({"a": {"shape": [18446744073709551616]}})", damaged + "'shape' of 'a' holds a number that is");
  expect_text_refusal(R"({"a": {"shape": [1,1,1,1,1,1,1,1,1]}})", damaged + "tensor 'a': shape has more than 8");
  expect_text_refusal(R"({"a": {"shape": [1], "data_offsets": [0, 0]}})", damaged + "tensor 'a' has no dtype");
  expect_text_refusal(R"({"a": {"dtype": "F32", "data_offsets": [0, 0]}})", damaged + "tensor 'a' has no shape");
  expect_text_refusal(R"({"a": {"dtype": "F32", "shape": [1]}})", damaged + "tensor 'a' lacks its two data_offsets");
  expect_text_refusal(R"({"a": {"dtype": "F32", "shape": [1], "data_offsets": [0]}})", damaged + "tensor 'a' lacks");
  expect_text_refusal(R"({"a": )" + std::string(100'000, '['), damaged + "'a' is a list");
  expect_text_refusal(std::string(100'000, '{'), damaged + "no JSON");
  expect_text_refusal(R"({"two)"
                      "\\n"
                      R"(lines": 1})",
                      damaged + "'two?lines' is a number");
}

TEST(PolicyFile, RefusesWrongPlaces) {
  const auto place = [](const char* name, std::uint64_t begin, std::uint64_t end, const std::string& part) {
    expect_header_refusal([&](Json& header) { header[name]["data_offsets"] = {begin, end}; }, part);
  };
  const std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
  place("embed_return.weight", 12, most, "truncated: tensor 'embed_return.weight' ends at byte 18446744073709551615");
  place("embed_return.weight", most, most, "truncated: tensor");
  place("embed_return.weight", 16, 12,
        "damaged header: tensor 'embed_return.weight' ends at 12, before its begin at 16");
  place("embed_return.weight", 8, 16,
        "damaged header: tensor 'embed_return.weight' begins at byte 8 of the data, inside");
  place("embed_return.weight", 12, 20,
        "damaged header: tensor 'embed_return.bias' begins at byte 16 of the data, inside");
  place("embed_return.weight", 14, 16,
        "damaged header: tensor 'embed_return.weight' begins at byte 14 of the data, but");
  place("embed_return.weight", 12, 12, "damaged header: tensor 'embed_return.bias' begins at byte 16 of the data, but");
  const std::uint64_t end = parts().data.size();
  place("predict_curact.0.bias", end - 8, end - 4, "4 bytes too many at its end");
  // Whole coverage, but two neighbours share it in another way.
  expect_header_refusal(
      [](Json& header) {
        header["embed_return.weight"]["data_offsets"] = {12, 20};
        header["embed_return.bias"]["data_offsets"] = {20, 20};
      },
      "tensor 'embed_return.weight' has 8 bytes, but its shape asks for 4");
}

TEST(PolicyFile, RefusesOtherTensors) {
  expect_header_refusal([](Json& header) { header["h.0.ln_1.bias"]["dtype"] = "BF16"; },
                        "tensor 'h.0.ln_1.bias' has dtype BF16; store it as F32");
  expect_header_refusal(
      [](Json& header) {
        header["h.0.ln_1.bias"]["shape"] = {1, 1};
      },
      "tensor 'h.0.ln_1.bias' has shape [1, 1], but the architecture asks for [1]");
  expect_header_refusal(
      [](Json& header) {
        header["h.0.attn.c_attn.weight"]["shape"] = {3, 1};
      },
      "tensor 'h.0.attn.c_attn.weight' has shape [3, 1], but the architecture asks for [1, 3]");
  expect_refusal(replaced("ln_f.bias", "ln_f.base"), "lacks tensor 'ln_f.bias' of its architecture");
  expect_header_refusal(
      [](Json& header) {
        const auto end = parts().data.size();
        header["more"] = {{"dtype", "F32"}, {"shape", {0}}, {"data_offsets", {end, end}}};
      },
      "tensor 'more' is not of its architecture");
}

TEST(PolicyFile, RefusesAnArchitectureThatItDoesNotHold) {
  expect_metadata_refusal("hidden", "0", "hidden = 0: expected 1 to 8192");
  expect_metadata_refusal("hidden", "8192",
                          "tensor 'embed_timestep.weight' has shape [3, 1], but the architecture asks");
  expect_metadata_refusal("layers", "256", "lacks tensor 'h.1.ln_1.weight'");
  expect_metadata_refusal("layers", "18446744073709551615", "layers = 18446744073709551615: expected 1 to 256");
  expect_metadata_refusal("hidden", "18446744073709551616",
                          "metadata 'hidden' is '18446744073709551616': expected a whole");
  expect_metadata_refusal("heads", "2", "heads = 2: expected 1 to 1");
  for (const char* number : {"", " 1", "1 ", "-1", "+1", "1.0", "0x1", "one"})
    expect_metadata_refusal("context", number,
                            "metadata 'context' is '" + std::string(number) + "': expected a whole number");
  expect_metadata_refusal("discrete", "True", "metadata 'discrete' is 'True': expected true or false");
  expect_metadata_refusal("readout", "dog", "metadata 'readout' is 'dog': expected token, cat, add or own");
  expect_metadata_refusal("belief_token", "false", "readout token reads the belief token");
  expect_metadata_refusal("token_layout", "belief return",
                          "metadata 'token_layout' is 'belief return': expected return observation belief action");
  expect_metadata_refusal("observation", "numbers", "metadata 'observation' is 'numbers': expected start CC CD DC DD");
}

TEST(PolicyFile, RefusesWrongMetadata) {
  expect_metadata_refusal("action_names", "C", "metadata 'action_names' is 'C': expected a JSON list of texts");
  expect_metadata_refusal("action_names", "[1,2]", "metadata 'action_names' is '[1,2]': expected a JSON list");
  expect_metadata_refusal("action_names", R"(["C"])", "1 action_names: the architecture has 2 actions");
  expect_metadata_refusal("action_names", R"(["C","C"])", "action_names: expected at most 1024 different names");
  expect_metadata_refusal("action_names", std::string(70'000, '['), "metadata 'action_names' is '[[[");
  expect_metadata_refusal("loss_mode", "luck", "'luck' is no loss mode");
  for (const char* payoffs : {"", "T=5", "R=3,T=5,P=1,S=0", "T=5,R=3,P=1,S=0,X=1", "T=5,R=3,P=1,S0", "T=,R=3,P=1,S=0"})
    expect_metadata_refusal("payoffs", payoffs, "");
  expect_metadata_refusal("rounds", "0", "rounds = 0: expected 1 to");
  expect_metadata_refusal("criterion", "forever", "");
  for (const char* number : {"0", "-1", "nan", "inf", "1e999", "", "1,5"})
    expect_metadata_refusal("return_scale", number, "");
  expect_metadata_refusal("return_target", "inf", "return_target = inf: expected a finite number");
  expect_metadata_refusal("return_target", "much", "metadata 'return_target' is 'much': expected a decimal number");
  expect_metadata_refusal("final_action_loss", "nan", "final_action_loss = nan: expected a finite number");
  expect_metadata_refusal("seed", "-1", "metadata 'seed' is '-1'");
  expect_metadata_refusal("roster", "two\nlines", "checksum ");
  expect_metadata_refusal("a new key", "", "checksum ");
  expect_metadata_refusal("checksum", "0123\n", "checksum ");
  const Json metadata = parts().json()["__metadata__"];
  for (const auto& [key, value] : metadata.items())
    expect_header_refusal([key = key](Json& header) { header["__metadata__"].erase(key); },
                          key == "format" ? "a safetensors file, but no policy" : "metadata lacks '" + key + "'");
}

// Keys that no policy has are read over, but the checksum covers them as it covers all others.
TEST(PolicyFile, TakesAnAddedKeyWithItsChecksum) {
  const auto with_key = [](const std::string& text, bool with_checksum) {
    Json header = parts().json();
    auto& metadata = header["__metadata__"];
    metadata["extra_key"] = text;
    if (with_checksum) metadata["checksum"] = checksum(metadata.get<Texts>(), test::small_policy().parameters);
    return put_together(header.dump(), parts().data);
  };
  EXPECT_EQ(policy_bytes(parse_policy(with_key("added by a tool", true), "p.bin")), small_bytes());
  expect_refusal(with_key("added by a tool", false), "checksum ");
  expect_error<InputFileError>([&] { parse_policy(with_key("added by a tool", false), "p.bin"); },
                               ": metadata 'extra_key' was added; take it out or write the new checksum");
  auto twice_wrong = with_key("added by a tool", false);
  twice_wrong.back() = static_cast<char>(twice_wrong.back() ^ 1);
  expect_error<InputFileError>([&] { parse_policy(twice_wrong, "p.bin"); }, ": the contents were changed");
}

TEST(PolicyFile, NamesTheNumberThatIsNotFinite) {
  const auto with = [](std::size_t index, float number) {
    Parts small = parts();
    const auto word = std::bit_cast<std::uint32_t>(number);
    for (std::size_t i = 0; i < 4; ++i) small.data[4 * index + i] = static_cast<char>((word >> (8 * i)) & 0xFFU);
    return put_together(small.header, small.data);
  };
  const float infinity = std::numeric_limits<float>::infinity();
  expect_refusal(with(2, std::numeric_limits<float>::quiet_NaN()),
                 "tensor 'embed_timestep.weight' holds nan at [2, 0]");
  expect_refusal(with(4, -infinity), "tensor 'embed_return.bias' holds -inf at [0]");
  const ParameterLayout layout(test::small_policy().architecture);
  expect_refusal(with(layout["embed_state.weight"].offset + 4, infinity),
                 "tensor 'embed_state.weight' holds inf at [0, 4]");
}

TEST(PolicyFile, DoesNotWriteWhatItWouldNotRead) {
  const auto refuses = [](const std::function<void(Policy&)>& change, const std::string& part) {
    Policy policy = test::small_policy();
    change(policy);
    expect_error<UsageError>([&] { policy_bytes(policy); }, part);
  };
  refuses([](Policy& p) { p.parameters.pop_back(); }, "parameters: the architecture has");
  refuses([](Policy& p) { p.architecture.hidden = 0; }, "hidden = 0");
  refuses([](Policy& p) { p.parameters[0] = std::numeric_limits<float>::quiet_NaN(); }, "holds nan at [0, 0]");
  refuses([](Policy& p) { p.action_names = {"C"}; }, "1 action_names");
  refuses([](Policy& p) { p.action_names[0] = std::string(70'000, 'x'); }, "action_names: longer than 65536 bytes");
  refuses([](Policy& p) { p.training.return_scale = 0; }, "return_scale = 0");
  refuses([](Policy& p) { p.training.criterion = ""; }, "");
  refuses([](Policy& p) { p.training.final_belief_loss = std::numeric_limits<double>::quiet_NaN(); },
          "final_belief_loss");
  refuses([](Policy& p) { p.training.roster = std::string(2'000'000, 'x'); }, "shorten the texts");
}

}  // namespace
}  // namespace folk::sct
