// Transformers as predators: what they look at, beliefs that are put into them, and what every controller must keep to.

#include <folk/mpe/evaluation/episodes.h>
#include <folk/mpe/players/noisy.h>
#include <folk/mpe/players/policy_file.h>
#include <folk/mpe/players/scripted.h>
#include <folk/mpe/players/transformer_player.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "games/expect_error.h"
#include "mpe/players/conformance.h"
#include "mpe/players/small_transformer.h"

namespace folk::mpe {
namespace {

using folk::test::expect_error;
using testing::small_mind;
using testing::TransformerKind;

constexpr TransformerKind selfconf{"selfconf", sct::LossMode::selfconf};
constexpr TransformerKind own{"own", sct::LossMode::teacher, sct::Readout::own};
constexpr TransformerKind madt{"madt", sct::LossMode::action_only, sct::Readout::own, false};

Controller player(const std::shared_ptr<const TransformerMind>& mind, TransformerPlay play = {}) {
  return transformer_controller("t", mind, Scenario::named(mind->policy.scenario), std::move(play));
}

Controller released(const Scenario& scenario) {
  return policy_controller("released", untrained_policy(scenario, Side::prey, 3, 8), Side::prey, scenario);
}

// ---- what all must keep to ---------------------------------------------------------------------------------------

TEST(TransformerPlayer, PlaysAsAllControllersMust) {
  for (const char* name : {"simple_tag", "simple_world"})
    for (const auto& kind : {TransformerKind{"teacher"}, selfconf, madt})
      testing::expect_sound_controller(player(small_mind(kind, name, {.context = 3, .layers = 1})), Side::predators,
                                       Scenario::named(name));
  testing::expect_sound_controller(player(small_mind(selfconf, "simple_tag", {.hidden = 32, .layers = 1, .heads = 1})),
                                   Side::predators, Scenario::named("simple_tag"));
}

TEST(TransformerPlayer, WithForcedBeliefsPlaysAsAllControllersMust) {
  const auto mind = small_mind(selfconf, "simple_tag", {.context = 3, .layers = 1});
  for (const auto forcing : {BeliefForcing::truth, BeliefForcing::zero})
    testing::expect_sound_controller(player(mind, {{}, forcing, random_player()}), Side::predators,
                                     Scenario::named("simple_tag"));
}

TEST(TransformerPlayerThreads, ChangeNoBit) {
  const Layout layout(Scenario::named("simple_tag"));
  const auto mind = small_mind(selfconf, "simple_tag", {.context = 4, .layers = 1});
  const auto returns = [&](BeliefForcing forcing, unsigned threads) {
    const auto prey = blend(0.5, released(layout.scenario()));
    std::vector<double> sums;
    for (const auto& score : score_episodes(layout, {player(mind, {{}, forcing, prey}), prey},
                                            {.seed = 4, .episodes = 70, .threads = threads}))
      sums.push_back(score.predators);
    return sums;
  };
  for (const auto forcing : {BeliefForcing::none, BeliefForcing::truth, BeliefForcing::other_episode}) {
    const auto one = returns(forcing, 1);
    EXPECT_EQ(returns(forcing, 3), one);
  }
}

// ---- what is seen, believed and done -----------------------------------------------------------------------------

using Thoughts = std::map<std::pair<std::uint64_t, std::size_t>, ThoughtRecord>;  ///< by episode and step

/// Plays, and keeps every thought; none may come twice.
Thoughts play(const Layout& layout, const std::shared_ptr<const TransformerMind>& mind, const Controller& prey,
              TransformerPlay how, const EpisodePlan& plan, double noise,
              const std::function<std::unique_ptr<Watcher>(std::size_t)>& watcher) {
  Thoughts thoughts;
  std::mutex mutex;
  how.prey = prey;
  how.witness = [&](const ThoughtRecord& thought) {
    const std::lock_guard lock(mutex);
    EXPECT_TRUE(thoughts.emplace(std::pair(thought.episode, thought.step), thought).second);
  };
  play_episodes(layout, {noisy(player(mind, how), noise), prey}, plan, watcher);
  return thoughts;
}

/// Thinks each episode of a block through, alone, from what is played in it, and keeps what should have been thought
/// and done.
class Examiner final : public Watcher {
public:
  Examiner(const TransformerMind& mind, const TransformerPlay& how, bool noise, Thoughts& expected)
      : mind_(mind),
        how_(how),
        noise_(noise),
        expected_(expected) {}

  void acted(const Layout& layout, const Block& block, const Moment& moment) override {
    const std::size_t width = layout.observation_begin(3);
    std::vector<std::array<float, 8>> actions(block.lanes);
    for (std::size_t lane = 0; lane < block.lanes; ++lane)
      for (std::size_t k = 0; k < 8; ++k) actions[lane][k] = static_cast<float>(block.actions[k * block_lanes + lane]);
    if (moment.step == 0) {
      past_.assign(block.lanes, {});
      rewards_.assign(block.lanes, 0);
      for (std::size_t lane = 0; lane < block.lanes; ++lane)
        thinkers_.push_back(
            std::make_unique<TransformerThinker>(mind_, 1, how_.target.value_or(mind_.policy.return_target)));
    }
    for (std::size_t lane = 0; lane < block.lanes; ++lane) {
      std::vector<float> seen(width);
      for (std::size_t k = 0; k < width; ++k) seen[k] = static_cast<float>(block.observations[k * block_lanes + lane]);
      const auto& past = past_[lane];
      const std::array glimpses{
          Glimpse{seen, rewards_[lane], std::span<const float, 2>(past.data() + 6, 2), std::span(past.data(), 6)}};
      auto& thinker = *thinkers_[lane];
      const Matrix<float> belief = thinker.see(glimpses);
      const Matrix<float> free = thinker.act(belief);
      Matrix<float> done = free;
      if (how_.forcing != BeliefForcing::none) {
        Matrix<float> forced = Matrix<float>::Zero(1, 2);
        const std::size_t from = how_.forcing == BeliefForcing::truth ? lane : (lane + 1) % block.lanes;
        if (how_.forcing != BeliefForcing::zero) forced << actions[from][6], actions[from][7];
        done = thinker.act(forced);
      }
      ThoughtRecord thought{moment.first + lane, moment.step, {belief(0, 0), belief(0, 1)}, 0};
      for (Index i = 0; i < 3; ++i)
        thought.change +=
            std::hypot(static_cast<double>(done(0, 2 * i)) - static_cast<double>(free(0, 2 * i)),
                       static_cast<double>(done(0, 2 * i + 1)) - static_cast<double>(free(0, 2 * i + 1))) /
            3;
      expected_.emplace(std::pair(thought.episode, thought.step), thought);
      for (Index k = 0; !noise_ && k < 6; ++k)
        EXPECT_EQ(actions[lane][static_cast<std::size_t>(k)], done(0, k))
            << "lane " << lane << ", step " << moment.step;
      past_[lane] = actions[lane];
    }
  }

  void stepped(const Layout&, const Block& block, const Moment&) override {
    for (std::size_t lane = 0; lane < block.lanes; ++lane) rewards_[lane] = static_cast<float>(block.rewards[lane]);
  }

private:
  const TransformerMind& mind_;
  const TransformerPlay& how_;
  bool noise_;
  Thoughts& expected_;
  std::vector<std::unique_ptr<TransformerThinker>> thinkers_;
  std::vector<std::array<float, 8>> past_;
  std::vector<float> rewards_;
};

/// Plays 19 episodes, more than are thought through together, and expects that all is thought and done as it should
/// be. The mean change of the actions.
double expect_right(const TransformerKind& kind, const std::string& name, const Controller& prey,
                    const TransformerPlay& how = {}, double noise = 0) {
  const ::testing::ScopedTrace trace(
      __FILE__, __LINE__,
      std::string(kind.name) + " against " + prey.name + ", " + std::string(to_string(how.forcing)));
  const Layout layout(Scenario::named(name));
  const auto mind = small_mind(kind, name, {.context = 4, .layers = 1}, 2);
  Thoughts expected;
  const auto thoughts = play(layout, mind, prey, how, {.seed = 3, .first = 11, .episodes = 19}, noise,
                             [&](std::size_t) { return std::make_unique<Examiner>(*mind, how, noise > 0, expected); });
  EXPECT_EQ(thoughts.size(), 19U * 25);
  EXPECT_EQ(expected.size(), thoughts.size());
  double change = 0;
  for (const auto& [where, thought] : thoughts) {
    EXPECT_EQ(thought.belief, expected.at(where).belief) << where.first << ", " << where.second;
    EXPECT_NEAR(thought.change, expected.at(where).change, 1e-6) << where.first << ", " << where.second;
    change += thought.change / static_cast<double>(thoughts.size());
  }
  return change;
}

TEST(TransformerPlayer, ActsOnItsBeliefsOfWhatIsPlayed) {
  for (const char* name : {"simple_tag", "simple_world"})
    for (const auto& kind : testing::transformer_kinds) EXPECT_EQ(expect_right(kind, name, random_player()), 0);
}

TEST(TransformerPlayer, AsksForTheReturnThatItIsTold) {
  TransformerPlay how;
  how.target = 40;
  expect_right(selfconf, "simple_tag", random_player(), how);
  const Layout layout(Scenario::named("simple_tag"));
  const auto deeds = [&](const TransformerPlay& play) {
    testing::Table table(layout, player(small_mind(), play), Side::predators);
    return table.play(1, 0, 1);
  };
  EXPECT_NE(deeds(how), deeds({}));
  how.target = small_mind()->policy.return_target;
  EXPECT_EQ(deeds(how), deeds({}));
}

TEST(TransformerPlayer, SeesTheActionsAsTheyWerePlayedAfterNoise) {
  for (const auto& kind : {TransformerKind{"teacher"}, selfconf})
    expect_right(kind, "simple_tag", random_player(), {}, 0.5);
}

TEST(ForcedBeliefs, OfTruthAreWhatThePreyThenDoes) {
  const auto scenario = Scenario::named("simple_tag");
  for (const auto& prey : {released(scenario), random_player(), random_player(RandomRule::program),
                           blend(0.5, released(scenario)), blend(0.5, released(scenario), Coin::batch), still_player()})
    for (const auto& kind : {TransformerKind{"teacher"}, selfconf})
      EXPECT_GT(expect_right(kind, "simple_tag", prey, {{}, BeliefForcing::truth, {}}), 0.01);
  const auto world = Scenario::named("simple_world");
  EXPECT_GT(expect_right(selfconf, "simple_world", blend(0.5, released(world)), {{}, BeliefForcing::truth, {}}), 0.01);
}

TEST(ForcedBeliefs, OfAnotherEpisodeAreWhatThePreyDoesInTheNext) {
  const auto scenario = Scenario::named("simple_tag");
  for (const auto& prey : {released(scenario), random_player()})
    EXPECT_GT(expect_right(selfconf, "simple_tag", prey, {{}, BeliefForcing::other_episode, {}}), 0.01);
}

/// Goes where the number of its episode says, which it learns when the episode begins.
class Starter final : public Player {
public:
  void start(const Layout&, const Block&, std::size_t, const Moment& moment) override { first_ = moment.first + 1; }
  void act(const Layout&, const Block& block, std::size_t agent, const Moment& moment) override {
    const auto [x, y] = action_rows(block, agent);
    for (std::size_t lane = 0; lane < block.lanes; ++lane) {
      x[lane] = std::sin(static_cast<double>((first_ + lane) * (moment.step + 2)));
      y[lane] = std::cos(static_cast<double>((first_ + lane) * (moment.step + 3)));
    }
  }

private:
  std::uint64_t first_ = 0;
};

TEST(ForcedBeliefs, OfTruthAreThoseOfAPreyThatMustBeStarted) {
  const Controller prey{"starter", each([](const Layout&, std::size_t) -> std::unique_ptr<Player> {
                          return std::make_unique<Starter>();
                        })};
  for (const auto forcing : {BeliefForcing::truth, BeliefForcing::other_episode})
    EXPECT_GT(expect_right(selfconf, "simple_tag", prey, {{}, forcing, {}}), 0.01);
}

TEST(ForcedBeliefs, LeaveWhatThePreyDidWhereItStands) {
  const Layout layout(Scenario::named("simple_tag"));
  Batch batch(layout.scenario(), 1);
  batch.reset(1);
  const Block block = batch.block(0);
  const auto [x, y] = action_rows(block, 3);
  *x = 0.25, *y = -0.75;
  const auto team = player(small_mind(), {{}, BeliefForcing::truth, random_player()}).team(layout, Side::predators);
  team[0]->start(layout, block, 0, {});
  team[0]->act(layout, block, 0, {});
  EXPECT_EQ(*x, 0.25);
  EXPECT_EQ(*y, -0.75);
}

TEST(ForcedBeliefs, OfZeroAreZero) {
  for (const auto readout : {sct::Readout::cat, sct::Readout::add, sct::Readout::token})
    EXPECT_GT(expect_right({"t", sct::LossMode::teacher, readout}, "simple_tag", random_player(),
                           {{}, BeliefForcing::zero, {}}),
              0.01);
}

TEST(ForcedBeliefs, ChangeNothingWhereTheyAreTheBelief) {
  // The beliefs of a network of zeros are zero.
  const auto mind = std::make_shared<const TransformerMind>(testing::zero_transformer());
  const Layout layout(Scenario::named("simple_tag"));
  const auto thoughts = play(layout, mind, random_player(), {{}, BeliefForcing::zero, {}}, {.episodes = 2}, 0,
                             [](std::size_t) { return std::make_unique<Watcher>(); });
  for (const auto& [where, thought] : thoughts) EXPECT_EQ(thought.change, 0);
}

TEST(ForcedBeliefs, AskThePreyNothingOfWhichThePlayDepends) {
  // A prey that is asked twice plays on as if it were asked once.
  const Layout layout(Scenario::named("simple_tag"));
  const auto mind = small_mind();
  const auto prey = blend(0.5, released(layout.scenario()));
  const auto prey_deeds = [&](BeliefForcing forcing) {
    std::vector<double> deeds;
    class Scribe final : public Watcher {
    public:
      explicit Scribe(std::vector<double>& deeds)
          : deeds_(deeds) {}
      void acted(const Layout&, const Block& block, const Moment& moment) override {
        if (moment.step == 0)
          deeds_.insert(deeds_.end(), block.actions + 6 * block_lanes, block.actions + 8 * block_lanes);
      }

    private:
      std::vector<double>& deeds_;
    };
    play_episodes(layout, {player(mind, {{}, forcing, prey}), prey}, {.episodes = 64},
                  [&](std::size_t) { return std::make_unique<Scribe>(deeds); });
    return deeds;
  };
  EXPECT_EQ(prey_deeds(BeliefForcing::truth), prey_deeds(BeliefForcing::none));
}

// ---- a team ------------------------------------------------------------------------------------------------------

/// The actions of the predators in two steps of an episode, asked in some order.
std::vector<double> deeds_in_order(const Team& team, const std::array<std::size_t, 3>& order, std::uint64_t episode,
                                   std::size_t steps = 2) {
  const auto scenario = Scenario::named("simple_tag");
  const Layout layout(scenario);
  Batch batch(scenario, 1);
  batch.reset(1, episode);
  const Block block = batch.block(0);
  Moment moment{1, episode, 0};
  std::vector<double> deeds;
  for (const std::size_t agent : order) team[agent]->start(layout, block, agent, moment);
  for (; moment.step < steps; ++moment.step) {
    for (const std::size_t agent : order) team[agent]->act(layout, block, agent, moment);
    for (std::size_t k = 0; k < 6; ++k) deeds.push_back(block.actions[k * block_lanes]);
    step(layout, block);
  }
  return deeds;
}

TEST(TransformerTeam, IsLedByWhoeverIsAskedFirst) {
  const Layout layout(Scenario::named("simple_tag"));
  int thoughts = 0;
  TransformerPlay how;
  how.witness = [&](const ThoughtRecord&) { ++thoughts; };
  const auto controller = player(small_mind(), how);
  const auto in_order = deeds_in_order(controller.team(layout, Side::predators), {0, 1, 2}, 7, 5);
  EXPECT_EQ(thoughts, 5);
  EXPECT_EQ(deeds_in_order(controller.team(layout, Side::predators), {2, 0, 1}, 7, 5), in_order);
  EXPECT_EQ(thoughts, 10);
  EXPECT_EQ(std::set<double>(in_order.begin(), in_order.end()).size(), in_order.size());
}

TEST(TransformerTeam, ForgetsAnEpisodeThatWasLeft) {
  const Layout layout(Scenario::named("simple_tag"));
  const auto controller = player(small_mind(selfconf));
  const auto stays = controller.team(layout, Side::predators);
  for (const std::size_t steps : {1, 3, 25}) {
    deeds_in_order(stays, {0, 1, 2}, 7, steps);
    EXPECT_EQ(deeds_in_order(stays, {0, 1, 2}, 8),
              deeds_in_order(controller.team(layout, Side::predators), {0, 1, 2}, 8));
  }
}

TEST(TransformerTeam, IsThreePredators) {
  const Layout layout(Scenario::named("simple_tag"));
  const auto controller = player(small_mind());
  EXPECT_EQ(controller.team(layout, Side::predators).size(), 3U);
  EXPECT_FALSE(controller.one_by_one);
  expect_error<UsageError>([&] { controller.team(layout, Side::prey); },
                           "a transformer plays the predators, not the prey");
}

// ---- refusals ----------------------------------------------------------------------------------------------------

TEST(TransformerPlayerRefusal, OfWhatMakesNoSense) {
  const auto scenario = Scenario::named("simple_tag");
  const auto refused = [&](const std::shared_ptr<const TransformerMind>& mind, const TransformerPlay& play,
                           const std::string& part) {
    expect_error<UsageError>([&] { transformer_controller("a\nname", mind, scenario, play); }, "a?name: " + part);
  };
  refused(small_mind({"t"}, "simple_world"), {}, "a policy for simple_world, not for simple_tag");
  const auto prey = random_player();
  for (const auto& kind : {own, madt})
    for (const auto forcing : {BeliefForcing::truth, BeliefForcing::other_episode, BeliefForcing::zero})
      refused(small_mind(kind), {{}, forcing, prey}, "its actions do not look at the belief token");
  auto program = random_player();
  program.one_by_one = true;
  for (const auto forcing : {BeliefForcing::truth, BeliefForcing::other_episode}) {
    refused(small_mind(), {{}, forcing, {}}, "to force beliefs by what the prey will do");
    refused(small_mind(), {{}, forcing, program}, "to force beliefs by what the prey will do");
  }
  for (const auto forcing : {BeliefForcing::none, BeliefForcing::zero}) {  // which do not ask it
    EXPECT_EQ(transformer_controller("t", small_mind(), scenario, {{}, forcing, program}).name, "t");
    EXPECT_FALSE(transformer_controller("t", small_mind(), scenario, {{}, forcing, program}).one_by_one);
  }
  EXPECT_EQ(transformer_controller("t", small_mind(own), scenario, {{}, BeliefForcing::none, prey}).name, "t");
}

TEST(BeliefForcing, HasNames) {
  EXPECT_EQ(to_string(BeliefForcing::none), "none");
  EXPECT_EQ(to_string(BeliefForcing::truth), "truth");
  EXPECT_EQ(to_string(BeliefForcing::other_episode), "other-episode");
  EXPECT_EQ(to_string(BeliefForcing::zero), "zero");
}

}  // namespace
}  // namespace folk::mpe
