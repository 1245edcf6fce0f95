#include <folk/mpe/evaluation/episode_record.h>
#include <folk/mpe/evaluation/episodes.h>
#include <folk/mpe/players/exec_player.h>
#include <folk/mpe/players/scripted.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "games/expect_error.h"
#include "mpe/players/named_players.h"

namespace folk::mpe {
namespace {

using namespace std::chrono_literals;
using folk::test::expect_error;

const Layout& exec_layout(const std::string& scenario = "simple_tag") {
  static const Layout tag(Scenario::named("simple_tag"));
  static const Layout world(Scenario::named("simple_world"));
  return scenario == "simple_tag" ? tag : world;
}

/// As it is named in a list of players.
Controller named(const std::string& command) { return exec_controller(parse_program_call(":" + command)); }

/// A shell program that does `act` when it is asked and ends at the end.
std::string program(const std::string& act) {
  return "while read -r what rest; do case $what in act) " + act + ";; end) exit 0;; esac; done";
}

// ---- what is said ------------------------------------------------------------------------------------------------

TEST(ExecParticle, MovesAsTheProgramAnswers) {
  const Cast cast{exec_controller({program("echo 0.25 -0.5")}), named("\"" + program("echo 0 1e-2") + "\"")};
  const auto record = record_episode(exec_layout(), cast, 1, 0);
  ASSERT_EQ(record.rows.size(), 26U);
  for (std::size_t t = 1; t < 26; ++t)
    EXPECT_EQ(record.rows[t].actions, (std::vector<Point>{{0.25, -0.5}, {0.25, -0.5}, {0.25, -0.5}, {0, 0.01}}));
}

TEST(ExecParticle, TellsTheProgramWhatItsAgentObserves) {
  const testing::TemporaryFolder folder;
  const std::string heard = (folder.path() / "heard").string();
  const std::string listen = fmt::format(
      "while read -r line; do echo \"$line\" >> '{}'; case $line in act*) echo 0.5 0;; end) exit 0;; esac; done",
      heard);
  std::vector<EpisodeRecord> records(2);
  {
    // Two episodes on one table: the program hears of both.
    auto scenario = Scenario::named("simple_tag");
    scenario.episode_steps = 2;
    const Layout two_steps(scenario);
    const Cast cast{random_player(), exec_controller({listen})};
    score_episodes(two_steps, cast, {7, 3, 2, 1});
    for (const std::uint64_t e : {0, 1}) {
      records[e] = record_episode(two_steps, {random_player(), exec_controller({program("echo 0.5 0")})}, 7, 3 + e);
    }
  }
  std::ifstream file(heard);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  ASSERT_EQ(lines.size(), 7U);
  std::vector<std::string> seeds;
  for (std::size_t e = 0; e < 2; ++e) {
    const std::string opening = "episode simple_tag agent=3 steps=2 seed=";
    ASSERT_EQ(lines[3 * e].substr(0, opening.size()), opening);
    seeds.push_back(lines[3 * e].substr(opening.size()));
    EXPECT_EQ(seeds.back().find_first_not_of("0123456789"), std::string::npos);
    for (std::size_t t = 0; t < 2; ++t) {
      std::istringstream words(lines[3 * e + 1 + t]);
      std::string word;
      words >> word;
      EXPECT_EQ(word, "act");
      std::vector<double> numbers;
      while (words >> word) numbers.push_back(std::stod(word));
      EXPECT_EQ(numbers, records[e].rows[t].observations[3]);  // every bit of them
    }
  }
  EXPECT_NE(seeds[0], seeds[1]);
  EXPECT_EQ(lines.back(), "end");
}

TEST(ExecParticle, TakesQuotesOff) {
  const auto say = [](const std::string& command) { return named(command).name; };
  EXPECT_EQ(say("./player"), "exec:\"./player\"");
  EXPECT_EQ(say("\"./player 1\""), "exec:\"./player 1\"");
  EXPECT_EQ(say("\"echo \\\"a\\\" \\\\ b\""), "exec:\"echo \\\"a\\\" \\\\ b\"");
  const Cast cast{named("\"" + program("echo \\\"0.5 0.25\\\"") + "\""), still_player()};
  EXPECT_EQ(record_episode(exec_layout(), cast, 1, 0).rows[1].actions[2], (Point{0.5, 0.25}));
  EXPECT_TRUE(exec_controller({"x"}).one_by_one);
}

TEST(ExecParticle, RefusesCommandsThatAreNone) {
  for (const char* command : {"", "\"\"", "   ", "\" \""})
    expect_error<UsageError>([&] { named(command); }, "exec: has no command; write exec:\"COMMAND\"");
  expect_error<UsageError>([] { named("a\nb"); }, "exec: command 'a?b' has control characters");
  for (const auto time_out : {0ms, -1ms, 86'400'001ms})
    expect_error<UsageError>([&] { exec_controller({"true", {time_out, time_out}}); }, "expected 1 ms to a day");
}

TEST(ParseForce, ReadsTwoNumbers) {
  const auto expect = [](std::string_view line, double x, double y) {
    const Force force = parse_force(line);
    EXPECT_EQ(force.x, x) << line;
    EXPECT_EQ(force.y, y) << line;
  };
  expect("0.5 -1", 0.5, -1);
  expect("1e-3\t 2", 0.001, 2);
  expect("0 0 \t\r", 0, 0);
  expect("-1000000 1000000", -1e6, 1e6);
  for (const char* line : {"", " ", "1", "1 ", "1 2 3", " 1 2", "1,2", "a b", "nan 0", "0 nan", "inf 0", "0 -inf",
                           "1e7 0", "0 1e400", "0x1 0", "+1 0", "1 2x", "0.5  "})
    expect_error<UsageError>([&] { parse_force(line); },
                             fmt::format("answer '{}': expected an action, two numbers as in '0.5 -1'", line));
  expect_error<UsageError>([] { parse_force("1 \x01"); }, "answer '1 ?'");
}

// ---- the example -------------------------------------------------------------------------------------------------

bool has_python() { return std::system("python3 -c 'import sys' >/dev/null 2>&1") == 0; }

Controller example() {
  return exec_controller({"python3 '" FOLK_SOURCE_DIR "/examples/particle_player.py'", {60s, 60s}});
}

TEST(ExecParticle, ThePythonExampleIsALeadPursuit) {
  if (!has_python()) GTEST_SKIP() << "no python3";
  for (const char* name : {"simple_tag", "simple_world"}) {
    const auto record = record_episode(exec_layout(name), {example(), random_player()}, 3, 0);
    const auto wanted = record_episode(exec_layout(name), {lead_pursuit(), random_player()}, 3, 0);
    for (std::size_t t = 1; t < 26; ++t)
      for (std::size_t agent = 0; agent < 3; ++agent) {
        EXPECT_NEAR(record.rows[t].actions[agent].x, wanted.rows[t].actions[agent].x, 1e-9);
        EXPECT_NEAR(record.rows[t].actions[agent].y, wanted.rows[t].actions[agent].y, 1e-9);
      }
  }
}

TEST(ExecParticle, ThePythonExampleFlees) {
  if (!has_python()) GTEST_SKIP() << "no python3";
  const EpisodePlan plan{3, 0, 20, 1};
  double fleeing = 0;
  double still = 0;
  for (const auto& score : score_episodes(exec_layout("simple_world"), {greedy_pursuit(), example()}, plan)) {
    fleeing += score.predators;
    EXPECT_LT(score.outside_steps, 20);
  }
  for (const auto& score : score_episodes(exec_layout("simple_world"), {greedy_pursuit(), still_player()}, plan))
    still += score.predators;
  EXPECT_LT(fleeing, still);
}

// ---- programs that do not keep to it -----------------------------------------------------------------------------

/// Expects an episode with this prey to end with one line.
void expect_failure(const std::string& command, const std::string& part, std::chrono::milliseconds time_out = 60s) {
  const auto player = exec_controller({command, {time_out, time_out}});
  expect_error<EnvironmentError>(
      [&] {
        record_episode(exec_layout(), {still_player(), player}, 1, 0);
      },
      player.name + ": " + part);
}

TEST(HostileParticle, ThatEndsEarly) {
  expect_failure("false", "ended with exit status 1");
  expect_failure("exec 2>/dev/null; folk-no-such-program",
                 "ended with exit status 127: the shell found no such command");
  expect_failure("read -r a; read -r b; echo 0 0; exit 3", "ended with exit status 3");
  expect_failure("read -r a; kill -9 $$", "was killed by SIGKILL");
}

TEST(HostileParticle, ThatIsSilent) {
  expect_failure("sleep 100", "silent for 0.1 s", 100ms);
  expect_failure("read -r a; read -r b; printf '0 0'; sleep 100", "silent for 0.1 s", 100ms);
}

TEST(HostileParticle, ThatAnswersJunk) {
  for (const char* junk : {"", "C", "nan 0", "0 inf", "0.5", "0 0 0"})
    expect_failure(program(fmt::format("echo '{}'", junk)),
                   fmt::format("answer '{}': expected an action, two numbers as in '0.5 -1'", junk));
  expect_failure("read -r a; read -r b; head -c 100000 /dev/zero; sleep 100", "wrote a line of more than 4096 bytes");
}

// Written at once, the second answer is seen before the next question for certain.
TEST(HostileParticle, ThatSpeaksUnasked) {
  expect_failure(program("printf '0 0\\n0 0\\n'"),
                 "wrote a line before it was asked; only the line 'act' wants an answer");
}

TEST(HostileParticle, ThatSpeaksBeforeItIsAsked) { expect_failure("echo 1 1; " + program("echo 0 0"), "wrote "); }

// The next episode begins with a fresh program.
TEST(HostileParticle, DoesNotSpoilTheNextEpisode) {
  Batch batch(exec_layout().scenario(), 1);
  batch.reset(1);
  const Block block = batch.block(0);
  const auto player = exec_controller({"read -r a; read -r b; echo 0.5 0; read -r b; exit 1"}).player(exec_layout(), 3);
  for (int episode = 0; episode < 3; ++episode) {
    player->start(exec_layout(), block, 3, {});
    player->act(exec_layout(), block, 3, {});
    EXPECT_EQ(*action_rows(block, 3).x, 0.5);
    expect_error<EnvironmentError>(
        [&] {
          player->act(exec_layout(), block, 3, {1, 0, 1});
        },
        "ended with exit status 1");
  }
}

}  // namespace
}  // namespace folk::mpe
