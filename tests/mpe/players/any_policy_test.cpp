// Policy files of four kinds, told apart by what they say of themselves.

#include <folk/mpe/evaluation/episodes.h>
#include <folk/mpe/players/any_policy.h>
#include <folk/mpe/players/bcq_policy.h>
#include <folk/mpe/players/policy_file.h>
#include <folk/mpe/players/scripted.h>
#include <folk/mpe/players/transformer_player.h>
#include <folk/mpe/players/window_policy.h>

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "games/expect_error.h"
#include "mpe/players/safetensors_draft.h"
#include "mpe/players/small_transformer.h"

namespace folk::mpe {
namespace {

using folk::test::expect_error;
using testing::SafetensorsDraft;

WindowPolicy window_policy(const Scenario& scenario) {
  WindowPolicy policy;
  policy.scenario = scenario.name;
  policy.context = 2;
  policy.scale = {{0, 0, 0}, {1, 1, 1}};
  policy.shape = MlpShape({2 * team_observation_size(scenario), 5, 6});
  policy.parameters = initial_parameters(policy.shape, 3, 1);
  return policy;
}

BcqPolicy bcq_policy(const Scenario& scenario) {
  BcqPolicy policy;
  policy.scenario = scenario.name;
  policy.candidates = 3;
  const std::size_t observed = scenario.observation_size(0);
  const auto network = [](std::vector<std::size_t> widths) {
    const MlpShape shape(std::move(widths));
    return StoredNetwork{shape, initial_parameters(shape, 5, 1)};
  };
  for (int i = 0; i < 3; ++i)
    policy.networks.push_back(
        {network({observed + 4, 6, 2}), network({observed + 2, 4, 2}), network({observed + 2, 1})});
  return policy;
}

/// A file of a kind, and the controller that it must become.
struct Kind {
  std::string name;
  std::function<std::string(const Scenario&)> bytes;
  std::function<Controller(const Scenario&)> controller;
};

std::vector<Kind> kinds() {
  return {{"networks", [](const Scenario& s) { return policy_bytes(untrained_policy(s, Side::predators, 3, 4)); },
           [](const Scenario& s) {
             return policy_controller("p", untrained_policy(s, Side::predators, 3, 4), Side::predators, s);
           }},
          {"window", [](const Scenario& s) { return window_policy_bytes(window_policy(s)); },
           [](const Scenario& s) { return window_controller("p", window_policy(s), s); }},
          {"bcq", [](const Scenario& s) { return bcq_policy_bytes(bcq_policy(s)); },
           [](const Scenario& s) { return bcq_controller("p", bcq_policy(s), s); }},
          {"transformer",
           [](const Scenario& s) { return transformer_policy_bytes(testing::small_transformer({"t"}, s.name)); },
           [](const Scenario& s) { return transformer_controller("p", testing::small_mind({"t"}, s.name), s); }}};
}

std::vector<double> returns(const Controller& predators, const Scenario& scenario) {
  std::vector<double> sums;
  for (const auto& score : score_episodes(Layout(scenario), {predators, random_player()}, {.seed = 4, .episodes = 3}))
    sums.push_back(score.predators);
  return sums;
}

TEST(AnyPolicy, BecomesThePlayersOfItsKind) {
  for (const char* name : {"simple_tag", "simple_world"}) {
    const auto scenario = Scenario::named(name);
    for (const auto& kind : kinds()) {
      const auto found = any_policy_controller("p", kind.bytes(scenario), "file", Side::predators, scenario);
      EXPECT_EQ(found.name, "p") << kind.name;
      EXPECT_FALSE(found.one_by_one);
      EXPECT_EQ(returns(found, scenario), returns(kind.controller(scenario), scenario)) << kind.name;
    }
  }
}

TEST(AnyPolicy, MayBeThePreysWhereItIsOne) {
  const auto scenario = Scenario::named("simple_tag");
  const auto bytes = policy_bytes(untrained_policy(scenario, Side::prey, 3, 4));
  EXPECT_EQ(any_policy_controller("p", bytes, "file", Side::prey, scenario).name, "p");
  expect_error<UsageError>([&] { any_policy_controller("p", bytes, "file", Side::predators, scenario); },
                           "p: a policy of the prey, not of the predators");
}

TEST(AnyPolicy, OfThePredatorsIsRefusedForThePrey) {
  const auto scenario = Scenario::named("simple_tag");
  for (const auto& kind : kinds())
    expect_error<UsageError>([&] { any_policy_controller("p", kind.bytes(scenario), "file", Side::prey, scenario); },
                             "p: a policy of the predators, not of the prey");
}

TEST(AnyPolicy, OfAnotherScenarioIsRefused) {
  for (const auto& kind : kinds())
    expect_error<UsageError>(
        [&] {
          any_policy_controller("p", kind.bytes(Scenario::named("simple_world")), "file", Side::predators,
                                Scenario::named("simple_tag"));
        },
        "p: a policy for simple_world, not for simple_tag");
}

TEST(AnyPolicy, ThatIsDamagedIsRefusedByTheNameOfItsFile) {
  const auto scenario = Scenario::named("simple_tag");
  for (const auto& kind : kinds()) {
    const auto bytes = kind.bytes(scenario);
    const auto refused = [&](const std::string& damaged) {
      expect_error<InputFileError>(
          [&] { any_policy_controller("p", damaged, "some\nfile", Side::predators, scenario); }, "some?file: ");
    };
    refused(bytes.substr(0, bytes.size() - 1));
    refused(bytes.substr(0, 40));
    auto draft = SafetensorsDraft::of(bytes);
    draft.tensors.erase(draft.tensors.begin());
    refused(draft.bytes());
  }
}

TEST(AnyPolicy, OfNoKindIsRefused) {
  const auto scenario = Scenario::named("simple_tag");
  const auto refused = [&](const std::string& bytes, const std::string& part) {
    expect_error<InputFileError>([&] { any_policy_controller("p", bytes, "file", Side::predators, scenario); }, part);
  };
  refused("", "file: an empty file");
  refused("no policy at all", "file: ");
  for (const auto& kind : kinds()) {
    auto draft = SafetensorsDraft::of(kind.bytes(scenario));
    draft.metadata["format"] = "folk-mpe-future-9";
    refused(draft.bytes(), "file: format 'folk-mpe-future-9'");
    draft.metadata.erase("format");
    refused(draft.bytes(), "file: ");
  }
}

TEST(AnyPolicy, SaysWhetherItIsATransformer) {
  const auto scenario = Scenario::named("simple_tag");
  for (const auto& kind : kinds())
    EXPECT_EQ(is_transformer(kind.bytes(scenario), "file"), kind.name == "transformer") << kind.name;
  expect_error<InputFileError>([] { is_transformer("no policy at all", "some file"); }, "some file: ");
}

}  // namespace
}  // namespace folk::mpe
