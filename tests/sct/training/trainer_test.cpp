// Training runs: what they depend on, and that they learn.

#include <folk/games/error.h>
#include <folk/sct/data/tournament_data.h>
#include <folk/sct/training/trainer.h>
#include <folk/strategies/registry.h>
#include <games/expect_error.h>
#include <gtest/gtest.h>

namespace folk::sct {
namespace {

std::vector<Lesson> lessons(const std::string& roster = "all_c,all_d,tit_for_tat,pavlov") {
  std::vector<Lesson> lessons;
  for (const auto& trajectory : tournament_data(Registry::standard().roster(roster), {}, 10))
    lessons.push_back(imitation(trajectory));
  return lessons;
}

TrainingSettings small_run() {
  TrainingSettings settings;
  settings.architecture.hidden = 12;
  settings.architecture.layers = 2;
  settings.architecture.heads = 2;
  settings.architecture.context = 4;
  settings.architecture.time_rows = 10;
  settings.windows.windows = 12;
  settings.windows.context = 4;
  settings.optimiser.learning_rate = 1e-2;
  settings.optimiser.warmup_steps = 5;
  settings.averaging = 0.9;
  settings.seed = 3;
  return settings;
}

void expect_equal(const TrainingState& a, const TrainingState& b) {
  EXPECT_EQ(a.parameters, b.parameters);
  EXPECT_EQ(a.average, b.average);
  EXPECT_EQ(a.optimiser.first, b.optimiser.first);
  EXPECT_EQ(a.optimiser.second, b.optimiser.second);
  EXPECT_EQ(a.optimiser.steps, b.optimiser.steps);
}

TEST(TrainerThreads, GoOnFromAnyStepWithTheSameBitsOnAnyNumberOfThreads) {
  for (const auto mode : {LossMode::teacher, LossMode::selfconf}) {
    auto settings = small_run();
    settings.mode = mode;
    Trainer whole(settings, lessons());
    for (int step = 0; step < 6; ++step) whole.step();
    settings.threads = 2;
    Trainer first(settings, lessons());
    for (int step = 0; step < 4; ++step) first.step();
    settings.threads = 3;
    Trainer second(settings, lessons());
    second.step();
    second.restore(first.state());
    EXPECT_EQ(second.steps(), 4U);
    while (second.steps() < 6) second.step();
    expect_equal(second.state(), whole.state());
  }
}

TEST(Trainer, DependsOnItsSeed) {
  auto settings = small_run();
  Trainer one(settings, lessons());
  settings.seed = 4;
  Trainer other(settings, lessons());
  EXPECT_NE(one.parameters(), other.parameters());
}

TEST(Trainer, LearnsWhatConstantPlayersPlay) {
  auto settings = small_run();
  settings.dropout = 0;
  Trainer trainer(settings, lessons("all_c,all_d"));
  const auto first = trainer.step();
  Losses last;
  while (trainer.steps() < 150) last = trainer.step();
  EXPECT_GT(first.total(), 0.8);
  EXPECT_LT(last.action, 0.1);
  EXPECT_LT(last.belief, 0.35) << "only the first round's is unknown, and the return token tells much of it";
}

TEST(Trainer, AveragesItsParametersIfAsked) {
  auto settings = small_run();
  Trainer averaging(settings, lessons());
  settings.averaging = 0;
  Trainer plain(settings, lessons());
  const auto start = plain.parameters();
  averaging.step();
  plain.step();
  EXPECT_EQ(averaging.state().parameters, plain.parameters());
  EXPECT_TRUE(plain.state().average.empty());
  for (std::size_t i = 0; i < start.size(); ++i)  // after the first step its weight is 9/10
    EXPECT_NEAR(averaging.parameters()[i], start[i] + 0.9F * (plain.parameters()[i] - start[i]), 1e-6F);
}

TEST(Trainer, RefusesTheStateOfAnotherNetwork) {
  auto settings = small_run();
  Trainer trainer(settings, lessons());
  settings.architecture.hidden = 24;
  const Trainer larger(settings, lessons());
  test::expect_error<UsageError>([&] { trainer.restore(larger.state()); }, "another network");
  settings = small_run();
  settings.averaging = 0;
  const Trainer plain(settings, lessons());
  test::expect_error<UsageError>([&] { trainer.restore(plain.state()); }, "another network");
}

}  // namespace
}  // namespace folk::sct
