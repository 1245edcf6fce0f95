// Records of the study read back, and texts that are none.

#include <folk/mpe/study/study_record.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "cases.h"
#include "games/expect_error.h"

namespace folk::mpe {
namespace {

using folk::test::expect_error;
using Json = nlohmann::ordered_json;

RightBeliefs beliefs(double share) {
  RightBeliefs right;
  for (std::size_t r = 0; r < belief_radii.size(); ++r) right.right[r] = {share + static_cast<double>(r), 0.125};
  for (std::size_t r = 0; r < absolute_radii.size(); ++r) right.within[r] = {share - static_cast<double>(r), 0.0625};
  right.distance = {0.1, 0.3};
  return right;
}

/// A prey's record with everything in it, one with nothing that may be missing, and no two numbers alike.
StudyRecord full_record() {
  StudyRecord record;
  record.job = {"released", "simple_tag", "expert", "sct", 7};
  record.budget = "small";
  record.identity = "0123456789abcdef";
  record.folk = "1.2.3";
  record.training = "learner = sct\nhidden = 64\n";
  record.steps = 4'000;
  record.episodes = 512;
  record.data_return = 260.1;
  record.policy = "fedcba9876543210";
  PreyRecord prey;
  prey.prey = "released";
  prey.predators = {200.1, 3.3};
  for (std::size_t b = 0; b < report_batches; ++b) prey.batches.push_back(200 + 1.0 / static_cast<double>(b + 3));
  prey.target = 240;
  prey.data_target = 320;
  prey.data_target_predators = Mean{190.7, 4.1};
  prey.own_target = 260.1;
  prey.own_target_predators = Mean{180.9, 5.9};
  prey.beliefs = beliefs(0.7);
  prey.asked = {{0, {1.1, 2.2}, beliefs(0.3)}, {80, {3.3, 4.4}, std::nullopt}};
  prey.forced = {{"none", {5.5, 6.6}, {0, 0}, {0.5, 0}}, {"truth", {7.7, 8.8}, {-9.9, 1}, {0.25, 0.1}}};
  PreyRecord plain;
  plain.prey = "still";
  plain.predators = {-4.1, 0};
  record.preys = {prey, plain};
  return record;
}

void expect_refusal(const std::string& text, const std::string& why = {}) {
  expect_error<InputFileError>([&] { parse_record(text, "a\nfile"); }, "a?file: no record of a study (" + why);
  expect_error<InputFileError>([&] { parse_record(text, "f"); }, "); remove it, and its job is done again");
}

Json full_json() { return Json::parse(record_text(full_record())); }

TEST(StudyRecord, IsReadBack) {
  const auto record = full_record();
  const auto text = record_text(record);
  EXPECT_TRUE(text.ends_with("}\n"));
  EXPECT_TRUE(parse_record(text, "f") == record);
  EXPECT_EQ(record_text(parse_record(text, "f")), text);
  StudyRecord diverged;
  diverged.job = {"released", "simple_tag", "expert", "omar", 1};
  diverged.diverged = "training has diverged: \"x\" \\ \n";
  EXPECT_TRUE(parse_record(record_text(diverged), "f") == diverged);
}

TEST(StudyRecord, OfOneEpisodeHasNoInterval) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(mean_of({3, 0, nan, nan}).ci95, 0);
  EXPECT_EQ(mean_of({3, 0, nan, nan}).mean, 3);
}

/// Applies `change` to each member of each object of a JSON, one at a time, and tries the whole with it.
void for_each_member(Json& whole, Json& part, const std::string& path,
                     const std::function<void(Json& parent, const std::string& key, const std::string& path)>& act) {
  if (part.is_array())
    for (auto& element : part) for_each_member(whole, element, path, act);
  if (!part.is_object()) return;
  std::vector<std::string> keys;
  for (const auto& [key, unused] : part.items()) keys.push_back(key);
  for (const auto& key : keys) {
    for_each_member(whole, part[key], path + "/" + key, act);
    act(part, key, path + "/" + key);
  }
}

TEST(StudyRecord, WithoutAMemberIsRefusedUnlessItMayBeMissing) {
  const std::set<std::string> may{"/preys/target",
                                  "/preys/data_target",
                                  "/preys/data_target_return",
                                  "/preys/own_target",
                                  "/preys/own_target_return",
                                  "/preys/beliefs",
                                  "/preys/asked",
                                  "/preys/forced",
                                  "/preys/asked/beliefs"};
  auto json = full_json();
  std::size_t refused = 0, allowed = 0;
  for_each_member(json, json, "", [&](Json& parent, const std::string& key, const std::string& path) {
    SCOPED_TRACE(path);
    const Json before = parent;
    parent.erase(key);
    if (may.contains(path)) {
      ++allowed;
      EXPECT_FALSE(parse_record(json.dump(), "f") == full_record());
    } else {
      ++refused;
      expect_refusal(json.dump());
    }
    parent = before;
  });
  EXPECT_EQ(allowed, may.size());
  EXPECT_GT(refused, 100U);
  EXPECT_TRUE(parse_record(json.dump(), "f") == full_record());
}

TEST(StudyRecord, WithAMemberOfAnotherKindIsRefused) {
  auto json = full_json();
  for_each_member(json, json, "", [&](Json& parent, const std::string& key, const std::string& path) {
    SCOPED_TRACE(path);
    const Json before = parent[key];
    for (const Json& other : {Json{{"x", 1}}, Json::parse("[[1]]"), Json(true)}) {
      parent[key] = other;
      expect_refusal(json.dump());
    }
    parent[key] = before.is_string() ? Json(5) : Json("5");
    expect_refusal(json.dump());
    parent[key] = before;
  });
}

TEST(StudyRecord, HasWholeNumbersWhereItCounts) {
  for (const char* key : {"seed", "steps", "episodes"})
    for (const char* number : {"-1", "1e300", "7.5", "1e3", "18446744073709551616"}) {
      auto json = full_json();
      json[key] = Json::parse(number);
      expect_refusal(json.dump(), "a number that is not whole)");
    }
}

TEST(StudyRecord, HasFiniteNumbersAndNoIntervalBelowNothing) {
  auto json = full_json();
  auto text = json.dump();
  const std::string number = "\"data_return\":260.1";
  ASSERT_NE(text.find(number), std::string::npos);
  for (const char* bad : {"1e999", "NaN", "-Infinity", "null", "+1", "01"}) {
    auto changed = text;
    expect_refusal(changed.replace(text.find(number), number.size(), std::string("\"data_return\":") + bad));
  }
  json["preys"][0]["return"]["ci95"] = -1;
  expect_refusal(json.dump(), "an interval below 0)");
}

TEST(StudyRecord, OfOtherRadiiIsRefused) {
  for (const char* kind : {"right", "within"}) {
    auto json = full_json();
    auto& shares = json["preys"][0]["beliefs"][kind];
    const Json before = shares;
    shares[1]["radius"] = 0.11;
    expect_refusal(json.dump(), "other radii)");
    shares = before;
    shares.erase(2);
    expect_refusal(json.dump(), "other radii)");
    shares = before;
    shares.push_back(before[0]);
    expect_refusal(json.dump(), "other radii)");
  }
}

TEST(StudyRecord, OfOtherBatchesOrAnotherFormatIsRefused) {
  auto json = full_json();
  json["preys"][0]["batches"].erase(0);
  expect_refusal(json.dump(), "other batches)");
  json = full_json();
  json["format"] = "folk-mpe-study-2";
  expect_refusal(json.dump(), "another format)");
}

TEST(StudyRecord, ThatIsCutOrNoTextIsRefused) {
  const auto text = full_json().dump();
  for (std::size_t size = 0; size < text.size(); ++size)
    EXPECT_THROW(parse_record(text.substr(0, size), "f"), InputFileError) << size;
  expect_refusal(text + "x", "no JSON at its byte ");
  expect_refusal("", "no JSON at its byte 1)");
  expect_refusal("[]");
  expect_refusal("5");
  expect_refusal(std::string("\"\xff\x01\"", 4), "no JSON at its byte ");
}

TEST(StudyRecord, ThatIsNestedDeeplyIsRefused) {
  const std::size_t depth = folk::test::cases<std::size_t>(200'000);
  expect_refusal(std::string(depth, '['), "no JSON at its byte ");
  expect_refusal(std::string(depth, '[') + std::string(depth, ']'));
  auto json = full_json();
  auto text = json.dump();
  const std::string preys = "\"preys\":[";
  text.replace(text.find(preys), std::string::npos, preys + std::string(depth, '[') + std::string(depth, ']') + "]}");
  expect_refusal(text);
}

}  // namespace
}  // namespace folk::mpe
