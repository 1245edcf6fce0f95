#include <folk/games/error.h>
#include <folk/mpe/data/data_description.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "games/expect_error.h"

namespace folk::mpe {
namespace {

using folk::test::expect_error;

DataRecord record() {
  DataRecord record;
  record.description = {"1.2.3",
                        "simple_world",
                        RewardRule::paper,
                        "expert",
                        "expert",
                        "exec:\"a b\"",
                        0.1,
                        7,
                        (1ULL << 53U) + 1,
                        40,
                        25,
                        sct::NpyType::float64};
  record.figures = {0x0123456789ABCDEF, {185.6, 0.25}, {-190.125, std::nullopt}};
  return record;
}

TEST(DataDescription, IsReadBack) {
  const auto back = parse_metadata(metadata_text(record()), "metadata.json");
  ASSERT_TRUE(back);
  EXPECT_EQ(description_text(back->description), description_text(record().description));
  EXPECT_EQ(back->description.reward_rule, RewardRule::paper);
  EXPECT_EQ(back->description.type, sct::NpyType::float64);
  EXPECT_EQ(back->description.first_episode, (1ULL << 53U) + 1);
  EXPECT_EQ(back->description.transitions(), 1000U);
  EXPECT_EQ(back->figures.signature, 0x0123456789ABCDEFU);
  EXPECT_EQ(back->figures.predator.mean, 185.6);
  EXPECT_EQ(back->figures.predator.standard_error, 0.25);
  EXPECT_EQ(back->figures.prey.mean, -190.125);
  EXPECT_EQ(back->figures.prey.standard_error, std::nullopt);
  auto named = record();
  named.description.level = "";
  EXPECT_EQ(parse_metadata(metadata_text(named), "")->description.level, "");
}

TEST(DataDescription, OthersNotesAreLeftAlone) {
  EXPECT_EQ(parse_metadata("{}", "m"), std::nullopt);
  EXPECT_EQ(parse_metadata(R"({"format": "minari", "format_version": "x"})", "m"), std::nullopt);
  EXPECT_EQ(parse_metadata(R"({"format": 3, "deep": [[[[[[1]]]]]]})", "m"), std::nullopt);
}

TEST(DataDescription, RefusesWhatIsDamaged) {
  const auto refuse = [](const std::string& text, const std::string& part) {
    expect_error<InputFileError>([&] { parse_metadata(text, "m.json"); }, "m.json: " + part);
  };
  for (const char* text : {"", "[]", "3", "{", "\xFF", "{\"format\": \"folk-mpe-data\""})
    refuse(text, "no JSON object");
  refuse(R"({"format": "folk-mpe-data"})", "'format_version' is missing");
  refuse(R"({"format": "folk-mpe-data", "format_version": 2})",
         "a data set of format version 2, but this Folk reads 1");

  const std::vector<std::pair<std::string, std::string>> changes{
      {"\"seed\": 7", "\"seed\": -7"},
      {"\"seed\": 7", "\"seed\": 7.5"},
      {"\"scenario\": \"simple_world\"", "\"scenario\": 3"},
      {"\"reward_rule\": \"paper\"", "\"reward_rule\": \"mine\""},
      {"\"noise\": 0.1", "\"noise\": \"0.1\""},
      {"\"transitions\": 1000", "\"transitions\": 1001"},
      {"\"transitions\": 1000", "\"transitions\": 975"},
      {"\"episode_steps\": 25", "\"episode_steps\": 0"},
      {"\"dtype\": \"float64\"", "\"dtype\": \"float16\""},
      {"0123456789abcdef", "0123456789abcdeg"},
      {"0123456789abcdef", "0123"},
      {"\"mean\": 185.6", "\"mean\": null"},
      {"\"standard_error\": 0.25", "\"error\": 0.25"},
      {"\"predator_return\": {", "\"predator\": {"},
      {"\"level\": \"expert\"", "\"level\": []"},
      {"\"predators\": \"expert\",", ""}};
  const std::string whole = metadata_text(record());
  for (const auto& [from, to] : changes) {
    std::string text = whole;
    ASSERT_NE(text.find(from), std::string::npos) << from;
    text.replace(text.find(from), from.size(), to);
    refuse(text, "'");
  }
}

TEST(DataDescription, TellsWhatDiffers) {
  const auto here = record().description;
  const std::string there = description_text(here);
  EXPECT_EQ(difference(there, here), std::nullopt);
  const auto differs = [&](auto change) {
    auto other = here;
    change(other);
    return difference(there, other).value_or("nothing");
  };
  EXPECT_EQ(differs([](auto& d) { d.seed = 8; }), "seed = 7 there, 8 here");
  EXPECT_EQ(differs([](auto& d) { d.noise = 0.2; }), "noise = 0.1 there, 0.2 here");
  EXPECT_EQ(differs([](auto& d) { d.level = ""; }), "level = \"expert\" there, null here");
  EXPECT_EQ(differs([](auto& d) { d.type = sct::NpyType::float32; }), R"(dtype = "float64" there, "float32" here)");
  EXPECT_EQ(differs([](auto& d) { d.first_episode += 1; }),
            "first_episode = 9007199254740993 there, 9007199254740994 here");
  EXPECT_EQ(differs([](auto& d) { d.prey += std::string(200, 'x'); }).substr(0, 4), "prey");
  EXPECT_NE(differs([](auto& d) { d.folk_version = "2"; }), "nothing");
  EXPECT_NE(differs([](auto& d) { d.episodes = 41; }), "nothing");
  EXPECT_NE(differs([](auto& d) { d.reward_rule = RewardRule::program; }), "nothing");
  EXPECT_EQ(difference("{}", here), "no 'format' is there");
  EXPECT_EQ(difference("{", here), "no description of a data set is there");
}

TEST(DataDescription, NamesThatAreNoUtf8AreTheSameAgain) {
  auto odd = record().description;
  odd.predators = "policies/\xFF.safetensors";
  EXPECT_EQ(difference(description_text(odd), odd), std::nullopt);
}

}  // namespace
}  // namespace folk::mpe
