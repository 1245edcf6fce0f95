// Every controller there is, through the suite that all must pass.

#include <folk/mpe/players/names.h>
#include <folk/mpe/players/noisy.h>
#include <folk/mpe/players/policy_file.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "mpe/players/conformance.h"
#include "mpe/players/named_players.h"

namespace folk::mpe {
namespace {

using testing::expect_sound_controller;

/// Answers otherwise at every step of an episode.
constexpr const char* counting_program =
    "exec:\"n=0; while read -r what rest; do case $what in episode) n=0;; end) exit 0;;"
    " act) n=$((n+1)); echo \\\"0.$n -0.$n\\\";; esac; done\"";

std::vector<std::string> all_players(Side side) {
  std::vector<std::string> names{"still",
                                 "random",
                                 "random(program)",
                                 "blend(0.5)",
                                 "untrained(7)",
                                 "blend(0.25;still)",
                                 "blend(0.5;shared)",
                                 counting_program};
  const std::vector<std::string> more =
      side == Side::prey ? std::vector<std::string>{"released", "maddpg", "blend(0.9;maddpg)"}
                         : std::vector<std::string>{"expert", "medium", "lead_pursuit", "greedy_pursuit",
                                                    "blend(0.7;lead_pursuit;shared)"};
  names.insert(names.end(), more.begin(), more.end());
  return names;
}

TEST(ControllerConformance, OfEveryName) {
  const testing::StandInPolicies policies;
  for (const char* name : {"simple_tag", "simple_world"})
    for (const Side side : {Side::predators, Side::prey}) {
      const auto scenario = Scenario::named(name);
      for (const auto& spec : all_players(side))
        expect_sound_controller(controller(spec, side, scenario, policies.folder()), side, scenario);
      const auto file = policies.file(name, side == Side::prey ? "maddpg" : "medium").string();
      expect_sound_controller(controller(file, side, scenario, policies.folder()), side, scenario);
    }
}

TEST(ControllerConformance, OfThePoliciesThatAreShipped) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(FOLK_SOURCE_DIR "/data/mpe")) {
    if (entry.path().extension() != ".safetensors") continue;
    ++files;
    const auto policy = read_policy(entry.path());
    const auto scenario = Scenario::named(policy.scenario);
    expect_sound_controller(policy_controller(entry.path().filename().string(), policy, policy.side, scenario),
                            policy.side, scenario);
  }
  EXPECT_GE(files, 2);
}

TEST(ControllerConformance, OfNoisyPlayers) {
  const auto scenario = Scenario::named("simple_world");
  expect_sound_controller(noisy(lead_pursuit(), 0.3), Side::predators, scenario);
  expect_sound_controller(noisy(random_player(), 0.1), Side::prey, scenario);
}

// Several players of one controller, each on a thread of its own.
TEST(ControllerThreads, MayShareAController) {
  const testing::StandInPolicies policies;
  const Layout layout(Scenario::named("simple_tag"));
  for (const char* spec : {"blend(0.5)", "untrained(3)"}) {
    const auto shared = controller(spec, Side::prey, layout.scenario(), policies.folder());
    std::vector<std::vector<testing::Deeds>> deeds(3);
    std::vector<std::jthread> threads;
    for (auto& mine : deeds)
      threads.emplace_back([&] { mine = testing::Table(layout, shared, Side::prey).play(5, 0, 64); });
    threads.clear();
    EXPECT_EQ(deeds[1], deeds[0]);
    EXPECT_EQ(deeds[2], deeds[0]);
  }
}

// The name of a controller makes it again.
TEST(ControllerNames, AreReadBack) {
  const testing::StandInPolicies policies;
  const auto scenario = Scenario::named("simple_tag");
  const Layout layout(scenario);
  for (const Side side : {Side::predators, Side::prey})
    for (const auto& spec : all_players(side)) {
      const auto once = controller(spec, side, scenario, policies.folder());
      const auto again = controller(once.name, side, scenario, policies.folder());
      EXPECT_EQ(again.name, once.name);
      EXPECT_EQ(again.one_by_one, once.one_by_one);
      EXPECT_EQ(testing::Table(layout, again, side).play(2, 3, 1), testing::Table(layout, once, side).play(2, 3, 1))
          << spec;
    }
}

}  // namespace
}  // namespace folk::mpe
