#include <folk/games/error.h>
#include <folk/mpe/online/online_checkpoint.h>
#include <folk/mpe/online/training.h>
#include <folk/mpe/players/scripted.h>

#include <gtest/gtest.h>

#include "games/ended_work.h"
#include "games/expect_error.h"
#include "small_training.h"

namespace folk::mpe {
namespace {

using folk::test::expect_error;
using test::small_settings;

OnlineTraining training_of(const OnlineSettings& settings, const char* scenario = "simple_tag") {
  return OnlineTraining(Scenario::named(scenario), settings, random_player());
}

void go_on(OnlineTraining& training, std::uint64_t episodes) {
  while (training.episodes() < episodes) {
    if (training.evaluation_due()) training.evaluate();
    training.round();
  }
}

std::string bytes_of(const OnlineTraining& training) {
  return online_checkpoint(training, description(training, "random"));
}

TEST(OnlineTraining, GoesOnFromAnyRoundAsIfItHadNeverStopped) {
  for (const bool prey : {false, true}) {
    auto settings = small_settings();
    settings.prey_learns = prey;
    settings.target_noise = 0.2;
    auto whole = training_of(settings);
    go_on(whole, settings.episodes);
    for (std::uint64_t stop = 0; stop <= settings.episodes; stop += round_episodes) {
      auto first = training_of(settings);
      go_on(first, stop);
      const auto saved = bytes_of(first);
      auto second = training_of(settings);
      restore(second, saved, "saved", description(second, "random"));
      EXPECT_TRUE(bytes_of(second) == saved) << stop;
      go_on(second, settings.episodes);
      EXPECT_TRUE(bytes_of(second) == bytes_of(whole)) << stop;
    }
  }
}

TEST(OnlineTrainingThreads, ChangeNoBit) {
  auto settings = small_settings();
  auto one = training_of(settings);
  go_on(one, settings.episodes);
  settings.threads = 3;
  auto three = training_of(settings);
  go_on(three, settings.episodes);
  EXPECT_TRUE(bytes_of(one) == bytes_of(three));
}

TEST(OnlineTrainingThreads, EndTheirEvaluationsAsTheirProgressWishes) {
  auto settings = small_settings();
  settings.evaluation_episodes = 300;
  settings.episodes = 64 * 2;
  auto whole = training_of(settings);
  go_on(whole, settings.episodes);
  for (const unsigned threads : {1U, 4U}) {
    settings.threads = threads;
    folk::test::expect_ends([&](const Progress& progress) {
      auto training = training_of(settings);
      training.evaluate();
      training.round();
      const auto before = bytes_of(training);
      try {
        training.evaluate(progress);
      } catch (...) {
        EXPECT_EQ(training.history().size(), 1U);
        EXPECT_TRUE(bytes_of(training) == before);
        throw;
      }
      EXPECT_EQ(training.history().size(), 2U);
    });
  }
  // The run that goes on becomes what it would have been.
  auto training = training_of(settings);
  EXPECT_THROW(training.evaluate([](double) { throw folk::test::Enough(); }), folk::test::Enough);
  EXPECT_TRUE(training.evaluation_due());
  go_on(training, settings.episodes);
  EXPECT_TRUE(bytes_of(training) == bytes_of(whole));
}

TEST(OnlineTraining, EachSettingIsAnotherRun) {
  const auto run = [](auto change) {
    auto settings = small_settings();
    change(settings);
    auto training = training_of(settings);
    go_on(training, settings.episodes);
    return bytes_of(training).substr(1500);  // behind the description
  };
  const auto base = run([](OnlineSettings&) {});
  EXPECT_TRUE(base == run([](OnlineSettings&) {}));
  EXPECT_TRUE(base != run([](OnlineSettings& s) { s.seed = 2; }));
  EXPECT_TRUE(base != run([](OnlineSettings& s) { s.algorithm = Algorithm::maddpg; }));
  EXPECT_TRUE(base != run([](OnlineSettings& s) { s.critic = Critic::independent; }));
  EXPECT_TRUE(base != run([](OnlineSettings& s) { s.discount = 0.9; }));
  EXPECT_TRUE(base != run([](OnlineSettings& s) { s.averaging = 0.02; }));
  EXPECT_TRUE(base != run([](OnlineSettings& s) { s.clip = 0.01; }));
  EXPECT_TRUE(base != run([](OnlineSettings& s) { s.action_penalty = 0.1; }));
  EXPECT_TRUE(base != run([](OnlineSettings& s) { s.exploration = 0.2; }));
  EXPECT_TRUE(base != run([](OnlineSettings& s) { s.final_learning_rate = 1e-3; }));
  EXPECT_TRUE(base != run([](OnlineSettings& s) { s.update_every = 200; }));
}

TEST(OnlineTraining, EvaluatesWhereItShould) {
  auto settings = small_settings();
  settings.episodes = 300;  // the fifth round is the last
  settings.evaluate_every = 100;
  auto training = training_of(settings);
  for (;;) {
    if (training.evaluation_due()) training.evaluate();
    EXPECT_FALSE(training.evaluation_due());
    if (training.finished()) break;
    training.round();
  }
  std::vector<std::uint64_t> at;
  for (const auto& evaluation : training.history()) at.push_back(evaluation.episodes);
  EXPECT_EQ(at, (std::vector<std::uint64_t>{0, 128, 256, 320}));
  EXPECT_EQ(training.updates(), 20U);  // 400 transitions each, from the first 1600 on
}

TEST(OnlineTraining, APolicyIsThatOfItsEvaluation) {
  auto settings = small_settings();
  settings.prey_learns = true;
  auto training = training_of(settings, "simple_world");
  go_on(training, 256);
  const auto& evaluation = training.history()[1];
  const auto predators = training.policy(evaluation, Side::predators);
  ASSERT_EQ(predators.networks.size(), 3U);
  EXPECT_EQ(predators.networks[2].parameters, evaluation.actors[2]);
  EXPECT_EQ(predators.scenario, "simple_world");
  EXPECT_EQ(training.policy(evaluation, Side::prey).networks.at(0).parameters, evaluation.actors[3]);
  auto frozen = training_of(small_settings());
  frozen.evaluate();
  expect_error<UsageError>([&] { frozen.policy(frozen.history()[0], Side::prey); }, "the prey does not learn");
}

TEST(OnlineCheckpoint, OfAnotherRunIsRefusedByWhatDiffers) {
  auto settings = small_settings();
  auto training = training_of(settings);
  go_on(training, 128);
  const auto saved = bytes_of(training);
  const auto refuse = [&](OnlineSettings other, const std::string& prey, std::string_view part) {
    auto second = training_of(other);
    const auto before = bytes_of(second);
    expect_error<UsageError>([&] { restore(second, saved, "c", description(second, prey)); }, part);
    EXPECT_TRUE(bytes_of(second) == before);
  };
  auto other = settings;
  other.hidden = 9;
  refuse(other, "random", "hidden = 8 there, 9 here");
  other = settings;
  other.seed = 5;
  refuse(other, "random", "seed = 1 there, 5 here");
  refuse(settings, "still", "prey = random there, still here");
  other = settings;
  other.episodes = 64;
  refuse(other, "random", "beyond the last, 64");
  other.episodes = 64 * 9;  // a longer run is the same run
  auto longer = training_of(other);
  restore(longer, saved, "c", description(longer, "random"));
  EXPECT_EQ(longer.episodes(), 128U);
}

TEST(OnlineCheckpoint, DamageIsRefusedAndTheRunStays) {
  auto training = training_of(small_settings());
  go_on(training, 192);
  const auto saved = bytes_of(training);
  auto second = training_of(small_settings());
  const auto before = bytes_of(second);
  const auto refuse = [&](const std::string& bytes, std::string_view part) {
    expect_error<InputFileError>([&] { restore(second, bytes, "c", description(second, "random")); }, part);
    EXPECT_TRUE(bytes_of(second) == before);
  };
  refuse("", "no checkpoint of mpe-train");
  refuse(saved.substr(0, saved.size() / 2), "damaged checkpoint");
  for (std::size_t at = 20; at < saved.size(); at += saved.size() / 40) {
    auto changed = saved;
    changed[at] = static_cast<char>(changed[at] ^ 1);
    refuse(changed, "damaged checkpoint");
  }
}

TEST(OnlineSettings, EachIsHeldInItsRange) {
  const auto refuse = [](auto change, std::string_view part) {
    auto settings = small_settings();
    change(settings);
    expect_error<UsageError>([&] { require_sound(settings); }, part);
  };
  refuse([](OnlineSettings& s) { s.hidden = 0; }, "hidden 0");
  refuse([](OnlineSettings& s) { s.discount = 1; }, "discount 1");
  refuse([](OnlineSettings& s) { s.learning_rate = NAN; }, "learning-rate nan");
  refuse([](OnlineSettings& s) { s.final_learning_rate = 1; }, "final-learning-rate 1");
  refuse([](OnlineSettings& s) { s.averaging = 0; }, "averaging 0");
  refuse([](OnlineSettings& s) { s.episodes = 0; }, "episodes 0");
  refuse([](OnlineSettings& s) { s.memory = 10; }, "memory 10");
}

}  // namespace
}  // namespace folk::mpe
