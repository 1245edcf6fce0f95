#include <folk/mpe/players/names.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "games/expect_error.h"
#include "mpe/players/named_players.h"

namespace folk::mpe {
namespace {

using folk::test::expect_error;

const testing::StandInPolicies& policies() {
  static const testing::StandInPolicies policies;
  return policies;
}

Controller make(const std::string& spec, Side side, const char* scenario = "simple_tag") {
  return controller(spec, side, Scenario::named(scenario), policies().folder());
}

/// Expects a UsageError for a name of a side.
void expect_name_refusal(const std::string& spec, Side side, const std::string& part) {
  expect_error<UsageError>([&] { make(spec, side); }, part);
}

TEST(PlayerNames, AreMatchedWithoutCaseUnderscoresAndHyphens) {
  for (const char* spec : {"lead_pursuit", "LeadPursuit", "LEAD-PURSUIT", "leadpursuit"})
    EXPECT_EQ(make(spec, Side::predators).name, "lead_pursuit") << spec;
  for (const char* spec : {"random(program)", "Random(PROGRAM)", "RANDOM(pro-gram)"})
    EXPECT_EQ(make(spec, Side::prey).name, "random(program)") << spec;
  EXPECT_EQ(make("random(uniform)", Side::prey).name, "random");
  EXPECT_EQ(make("STILL", Side::prey).name, "still");
  EXPECT_EQ(make("Greedy_Pursuit", Side::predators).name, "greedy_pursuit");
  EXPECT_EQ(make("MADDPG", Side::prey).name, "maddpg");
  EXPECT_EQ(make("Un_trained(12)", Side::prey).name, "untrained(12)");
  EXPECT_EQ(make("untrained(1.2e1)", Side::prey).name, "untrained(12)");
}

TEST(PlayerNames, OfABlend) {
  EXPECT_EQ(make("blend(0.5)", Side::prey).name, "blend(0.5;released)");
  EXPECT_EQ(make("blend(0.5)", Side::predators).name, "blend(0.5;expert)");
  EXPECT_EQ(make("Blend(.25;STILL)", Side::prey).name, "blend(0.25;still)");
  EXPECT_EQ(make("blend(1;shared)", Side::prey).name, "blend(1;released;shared)");
  EXPECT_EQ(make("blend(0;lead-pursuit;SHARED)", Side::predators).name, "blend(0;lead_pursuit;shared)");
  EXPECT_EQ(make("blend(1/3;Lead Pursuit)", Side::predators).name, "blend(1/3;lead_pursuit)");
  EXPECT_EQ(make("blend(2/4;still)", Side::prey).name, "blend(0.5;still)");
  EXPECT_EQ(make("blend(0.5;random(program))", Side::prey).name, "blend(0.5;random(program))");
  EXPECT_EQ(make("blend(0.5;exec:\"a;shared\")", Side::prey).name, "blend(0.5;exec:\"a;shared\")");
}

TEST(PlayerNames, OfABlendThatMakesNoSense) {
  for (const char* p : {"1.5", "-0.1", "", "nan", "half", "0.5x", "0.5,still", " 0.5", "4/3", "1/0"})
    expect_name_refusal("blend(" + std::string(p) + ")", Side::prey,
                        "blend: probability '" + std::string(p) + "': expected a number from 0 to 1");
  expect_name_refusal("blend(0.5;lead_pursuit)", Side::prey, "'lead_pursuit': no player of the prey");
  expect_name_refusal("blend(0.5;stil)", Side::prey, "did you mean still?");
  expect_name_refusal("blend(0.5;still;sharde)", Side::prey, "no player of the prey");
  expect_name_refusal("blend(0.5;blend(0.5;still))", Side::prey, "a blend of a blend");
  expect_name_refusal("blend(0.5;BLEND(0.5);shared)", Side::prey, "a blend of a blend");
  std::string deep;  // far deeper than the stack
  for (int i = 0; i < 1'000'000; ++i) deep += "blend(1;";
  expect_name_refusal(deep + std::string(1'000'000, ')'), Side::prey, "a blend of a blend");
}

TEST(PlayerNames, OfTheWrongSide) {
  for (const char* spec : {"lead_pursuit", "greedy_pursuit", "expert", "medium"})
    expect_name_refusal(spec, Side::prey,
                        "'" + std::string(spec) + "': no player of the prey and no file has this name");
  for (const char* spec : {"released", "maddpg"}) {
    expect_name_refusal(spec, Side::predators, "'" + std::string(spec) + "': no player of the predators and no file");
    EXPECT_EQ(make(spec, Side::prey).name, spec);
  }
}

TEST(PlayerNames, ThatAreMisspeltAreShownTheNearest) {
  expect_name_refusal("lead_pursit", Side::predators, ": did you mean lead_pursuit");
  expect_name_refusal("reelased", Side::prey, ": did you mean released");
  expect_name_refusal("zzzzzzzzzzzzzz", Side::prey, "has this name (known: still, random, random(program), blend(P),");
  expect_name_refusal("", Side::prey, "''");
  expect_name_refusal("still(3)", Side::prey, "did you mean still");
  expect_name_refusal("a\nb", Side::prey, "'a?b'");
  expect_name_refusal(std::string(100'000, 'x'), Side::prey, "xxx...'");
}

TEST(PlayerNames, OfRandomAndUntrainedThatMakeNoSense) {
  expect_name_refusal("random(normal)", Side::prey, "random(normal): expected random or random(program)");
  expect_name_refusal("random()", Side::prey, "random(): expected random or random(program)");
  for (const char* seed : {"", "x", "-1", "1e300", "nan"})
    expect_name_refusal("untrained(" + std::string(seed) + ")", Side::prey,
                        "untrained: seed '" + std::string(seed) + "': expected a number from 0");
  expect_name_refusal("untrained(1.5)", Side::prey, "untrained: seed '1.5': expected a whole number");
}

TEST(PlayerNames, OfFiles) {
  const auto file = policies().file("simple_tag", "expert").string();
  EXPECT_EQ(make(file, Side::predators).name, file);
  EXPECT_EQ(make(file, Side::predators).file, file);
  EXPECT_EQ(make("expert", Side::predators).file, "");
  expect_error<InputFileError>([&] { make(file, Side::prey); }, file + ": a policy of the predators, not of the prey");
  expect_error<InputFileError>([&] { make(file, Side::predators, "simple_world"); },
                               file + ": a policy for simple_tag, not for simple_world");
  for (const char* missing : {"./no_such_file", "no_such.safetensors", "expert(0.5)"})
    expect_error<InputFileError>([&] { make(missing, Side::predators); }, missing);
  expect_error<InputFileError>([&] { make(policies().folder().string(), Side::prey); }, policies().folder().string());
}

// A file may have any name, also one without a dot, as long as it is there.
TEST(PlayerNames, OfAFileInTheFolderOneIsIn) {
  const auto here = std::filesystem::current_path();
  std::filesystem::current_path(policies().folder());
  std::filesystem::copy_file(policies().file("simple_tag", "maddpg"), "prey");
  EXPECT_EQ(make("prey", Side::prey).name, "prey");
  std::ofstream("junk") << "junk";
  expect_error<InputFileError>([] { make("junk", Side::prey); }, "junk: no safetensors file");
  std::filesystem::remove("prey");
  std::filesystem::remove("junk");
  std::filesystem::current_path(here);
}

TEST(PlayerNames, OfShippedPlayersThatAreNotThere) {
  const testing::TemporaryFolder empty;
  for (const char* spec : {"released", "blend(0.5)"})
    expect_error<InputFileError>([&] { controller(spec, Side::prey, Scenario::named("simple_world"), empty.path()); },
                                 "released: there is no " +
                                     (empty.path() / "simple_world_released.safetensors").string() +
                                     "; install Folk's data");
  EXPECT_EQ(controller("blend(0.5;still)", Side::prey, Scenario::named("simple_world"), empty.path()).name,
            "blend(0.5;still)");
}

TEST(PlayerNames, OfPrograms) {
  const auto player = make("exec:\"python3 player.py --depth 3\"", Side::prey);
  EXPECT_EQ(player.name, "exec:\"python3 player.py --depth 3\"");
  EXPECT_TRUE(player.one_by_one);
  EXPECT_EQ(make("exec:./player", Side::predators).name, "exec:\"./player\"");
  expect_name_refusal("exec:", Side::prey, "exec: has no command");
  expect_name_refusal("exec:\"\"", Side::prey, "exec: has no command");
}

TEST(SplitNames, AtCommasOutsideOfBracketsAndQuotes) {
  EXPECT_EQ(split_names("still, blend(0.5;still),exec:\"a,b\""),
            (std::vector<std::string>{"still", "blend(0.5;still)", "exec:\"a,b\""}));
  for (const char* list : {"", " ", ",", " , ,"})
    expect_error<UsageError>([&] { split_names(list); }, "no player is named");
  expect_error<UsageError>([] { split_names("blend(0.5"); }, "a bracket is not closed");
}

}  // namespace
}  // namespace folk::mpe
