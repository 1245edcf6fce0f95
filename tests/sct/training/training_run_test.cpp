#include <folk/games/error.h>
#include <folk/sct/data/tournament_data.h>
#include <folk/sct/policy/policy_file.h>
#include <folk/sct/training/training_run.h>
#include <folk/strategies/registry.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "games/ended_work.h"
#include "games/expect_error.h"

namespace folk::sct {
namespace {

using test::expect_error;

constexpr std::uint64_t rounds = 8;

TrainingSettings small_settings(unsigned threads = 1) {
  TrainingSettings settings;
  settings.architecture.hidden = 8;
  settings.architecture.layers = 1;
  settings.architecture.context = settings.windows.context = 5;
  settings.architecture.time_rows = rounds;
  settings.windows.windows = 6;
  settings.optimiser.learning_rate = 0.01;
  settings.optimiser.warmup_steps = 3;
  settings.averaging = 0.9;
  settings.threads = threads;
  return settings;
}

TrainingRun run_of(std::uint64_t steps = 10, unsigned threads = 1, std::string description = "seed = 1\n",
                   std::uint64_t aggregate_every = 0, std::uint64_t patience = 0, std::vector<Strategy> held_out = {}) {
  const auto roster = Registry::standard().roster("tit_for_tat,all_d,pavlov");
  std::vector<Lesson> lessons;
  for (const auto& trajectory : tournament_data(roster, {}, rounds)) lessons.push_back(imitation(trajectory));
  RunSettings settings;
  settings.steps = steps;
  settings.evaluate_every = 4;
  settings.targets = {20, 30};
  settings.validation.criterion = Criterion::finite(rounds);
  settings.validation.noise = 0.05;
  settings.validation.repetitions = 2;
  settings.validation.seed = 77;
  settings.validation.threads = threads;
  settings.description = std::move(description);
  settings.aggregate_every = aggregate_every;
  settings.aggregate_repetitions = 2;
  settings.patience = patience;
  settings.held_out = std::move(held_out);
  std::shared_ptr<const BayesTeacher> teacher;
  if (aggregate_every > 0) teacher = std::make_shared<const BayesTeacher>(roster, Payoffs{}, rounds, 20);
  TrainingRecord record;
  record.rounds = rounds;
  record.criterion = "finite:8";
  return {settings, small_settings(threads), std::move(lessons), roster, record, std::move(teacher)};
}

void go_on(TrainingRun& run, std::uint64_t to) {
  while (run.steps() < to) {
    run.step();
    if (run.evaluation_due()) run.evaluate();
  }
}

std::string whole_run() {
  auto run = run_of();
  go_on(run, 10);
  return policy_bytes(run.policy());
}

TEST(TrainingRun, EvaluatesAtMultiplesAndAtTheEnd) {
  auto run = run_of();
  go_on(run, 10);
  ASSERT_EQ(run.history().size(), 3U);
  EXPECT_EQ(run.history()[0].steps, 4U);
  EXPECT_EQ(run.history()[1].steps, 8U);
  EXPECT_EQ(run.history()[2].steps, 10U);
  EXPECT_EQ(run.history()[2].scores.size(), 2U);
  const auto& kept = run.history()[run.kept()];
  for (std::size_t i = 0; i < run.kept(); ++i) EXPECT_TRUE(takes_over(kept, run.history()[i]));
  for (std::size_t i = run.kept() + 1; i < 3; ++i) EXPECT_FALSE(takes_over(run.history()[i], kept));
}

TEST(TrainingRun, ThePolicyIsTheKeptOne) {
  auto run = run_of();
  go_on(run, 10);
  const auto policy = run.policy();
  const auto& kept = run.history()[run.kept()];
  EXPECT_EQ(policy.training.steps, kept.steps);
  EXPECT_EQ(policy.training.return_target, best_target(kept).target);
  EXPECT_EQ(policy.training.final_belief_loss, kept.belief_loss);
  auto again = run_of();
  go_on(again, kept.steps);
  EXPECT_EQ(policy.parameters, again.policy().parameters);
}

TEST(TrainingRun, GoesOnFromAnyStepAsIfItHadNeverStopped) {
  const auto whole = whole_run();
  for (std::uint64_t stop = 0; stop <= 10; ++stop) {
    auto first = run_of();
    go_on(first, stop);
    const auto saved = checkpoint_bytes(first.checkpoint());
    auto second = run_of();
    second.restore(parse_checkpoint(saved, "saved"));
    go_on(second, 10);
    EXPECT_EQ(policy_bytes(second.policy()), whole) << stop;
  }
}

TEST(TrainingRun, GoesOnWithWhatItsTeacherHasLabelled) {
  const auto begin = [](unsigned threads) { return run_of(10, threads, "seed = 1\n", 3); };
  auto whole = begin(1);
  go_on(whole, 10);
  EXPECT_EQ(whole.added(), 27U);  // at steps 3, 6 and 9, against each of 3 once without slips and twice with
  for (const std::uint64_t stop : {2, 3, 4, 8}) {
    auto first = begin(1);
    go_on(first, stop);
    auto second = begin(2);
    second.restore(parse_checkpoint(checkpoint_bytes(first.checkpoint()), "saved"));
    go_on(second, 10);
    EXPECT_EQ(checkpoint_bytes(second.checkpoint()), checkpoint_bytes(whole.checkpoint())) << stop;
  }
}

TEST(TrainingRun, GoesOnWithWhatItHasExplored) {
  const auto begin = [](unsigned threads) {
    const auto registry = Registry::standard();
    auto prior = read_prior(registry, "tit_for_tat,2*memory(1,1)", {});
    prior.slip = 0.01;
    RunSettings settings;
    settings.steps = 10;
    settings.evaluate_every = 4;
    settings.targets = {0};
    settings.validation.criterion = Criterion::finite(rounds);
    settings.explore_every = 3;
    settings.explore_matches = 5;
    auto training = small_settings(threads);
    training.windows.shows_return = false;
    training.architecture.observation_size = 2 * observation_size;
    TrainingRecord record;
    record.rounds = rounds;
    record.shows_return = false;
    record.plan_depth = 2;
    return TrainingRun(settings, training, {}, registry.roster("tit_for_tat,all_d"), record, nullptr,
                       std::make_shared<const Exploration>(std::move(prior), Payoffs{}, rounds));
  };
  auto whole = begin(1);
  EXPECT_EQ(whole.explored(), 10U);
  go_on(whole, 10);
  EXPECT_EQ(whole.explored(), 25U);
  EXPECT_EQ(whole.policy().training.plan_depth, 2U);
  for (const std::uint64_t stop : {0, 2, 3, 4, 8}) {
    auto first = begin(2);
    go_on(first, stop);
    auto second = begin(1);
    second.restore(parse_checkpoint(checkpoint_bytes(first.checkpoint()), "saved"));
    go_on(second, 10);
    EXPECT_EQ(checkpoint_bytes(second.checkpoint()), checkpoint_bytes(whole.checkpoint())) << stop;
  }
}

TEST(TrainingRun, EachAggregationDrawsItsOwnSlips) {
  RunSettings settings;
  settings.steps = 2;
  settings.targets = {20};
  settings.validation.criterion = Criterion::finite(rounds);
  settings.aggregate_every = 1;
  settings.aggregate_repetitions = 3;
  settings.aggregate_slip = 0.5;
  auto training = small_settings();
  training.optimiser.learning_rate = 0;  // the same policy plays each time
  const auto roster = Registry::standard().roster("tit_for_tat,all_d");
  std::vector<Lesson> lessons;
  for (const auto& trajectory : tournament_data(roster, {}, rounds)) lessons.push_back(imitation(trajectory));
  TrainingRun run(settings, training, std::move(lessons), roster, {},
                  std::make_shared<const BayesTeacher>(roster, Payoffs{}, rounds, 20));
  run.step();
  run.step();
  const auto added = run.checkpoint().added;
  const std::size_t opponents = roster.size();
  const std::size_t each = opponents * (1 + settings.aggregate_repetitions);  // first those without slips
  ASSERT_EQ(added.size(), 2 * each);
  for (std::size_t m = 0; m < each; ++m) EXPECT_EQ(added[m].own == added[each + m].own, m < opponents) << "match " << m;
}

TEST(TrainingRun, ThreadsChangeNothing) {
  auto first = run_of(10, 2);
  go_on(first, 5);
  auto second = run_of(10, 3);
  second.restore(first.checkpoint());
  go_on(second, 10);
  EXPECT_EQ(policy_bytes(second.policy()), whole_run());
}

TEST(TrainingRun, AnEvaluationThatIsStoppedHasNotBeen) {
  auto run = run_of();
  for (int i = 0; i < 4; ++i) run.step();
  const auto before = checkpoint_bytes(run.checkpoint());
  int asked = 0;
  EXPECT_THROW(run.evaluate({nullptr, [&] { return ++asked == 2; }}), Cancelled);
  EXPECT_EQ(checkpoint_bytes(run.checkpoint()), before);
  EXPECT_TRUE(run.evaluation_due());
  run.evaluate();
  EXPECT_FALSE(run.evaluation_due());
}

// Whatever ends an evaluation: a checkpoint is whole, and the run that goes on with it becomes what it would have been.
TEST(TrainingRunThreads, EndTheirEvaluationsAsTheirProgressWishes) {
  const auto whole = whole_run();
  for (const unsigned threads : {1U, 4U})
    test::expect_ends([&](const Progress& progress) {
      auto run = run_of(10, threads);
      for (int i = 0; i < 4; ++i) run.step();
      const auto before = checkpoint_bytes(run.checkpoint());
      try {
        run.evaluate(progress);
      } catch (...) {
        EXPECT_TRUE(run.evaluation_due());
        EXPECT_EQ(checkpoint_bytes(run.checkpoint()), before);
        auto other = run_of(10, threads);
        other.restore(parse_checkpoint(before, "saved"));
        for (auto* goes_on : {&run, &other}) {
          ASSERT_TRUE(goes_on->evaluation_due());
          goes_on->evaluate();
          go_on(*goes_on, 10);
          EXPECT_EQ(policy_bytes(goes_on->policy()), whole);
        }
        throw;
      }
      EXPECT_EQ(run.history().size(), 1U);
    });
}

TEST(TrainingRun, WhatIsHeldOutIsPlayedAndNotLearnt) {
  const auto held_out = Registry::standard().roster("all_c,per_cd");
  const auto begin = [&](std::uint64_t patience = 0) { return run_of(10, 1, "seed = 1\n", 0, patience, held_out); };
  auto plain = run_of();
  auto run = begin();
  go_on(plain, 10);
  go_on(run, 10);
  ASSERT_EQ(run.history().size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& evaluation = run.history()[i];
    EXPECT_EQ(evaluation.action_loss, plain.history()[i].action_loss);
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_EQ(evaluation.scores[k].total, plain.history()[i].scores[k].total);
      ASSERT_TRUE(evaluation.scores[k].held_out);
      EXPECT_LE(evaluation.scores[k].held_out->total, 2 * 5.0 * rounds);
    }
    EXPECT_LE(best_target(evaluation).held_out->total, best_target(run.history()[run.kept()]).held_out->total);
  }
  EXPECT_EQ(run.policy().training.return_target, best_target(run.history()[run.kept()]).target);
  for (const std::uint64_t stop : {4, 7, 9}) {
    auto first = begin();
    go_on(first, stop);
    auto second = begin();
    second.restore(parse_checkpoint(checkpoint_bytes(first.checkpoint()), "saved"));
    go_on(second, 10);
    EXPECT_EQ(second.history(), run.history());
    EXPECT_EQ(policy_bytes(second.policy()), policy_bytes(run.policy()));
  }
}

TEST(TrainingRun, EndsForWantOfPatienceAtTheSameStepHoweverItIsStopped) {
  const auto patient = [](std::uint64_t patience) { return run_of(100, 1, "seed = 1\n", 0, patience); };
  const auto to_the_end = [](TrainingRun& run) {
    while (!run.finished()) {
      run.step();
      if (run.evaluation_due()) run.evaluate();
    }
  };
  auto whole = patient(2);
  to_the_end(whole);
  ASSERT_TRUE(whole.stopped_early());
  const std::uint64_t end = whole.steps();
  EXPECT_EQ(end % 4, 0U);
  EXPECT_EQ(end_of_patience(whole.history(), 2), whole.history().size() - 1);
  for (const std::uint64_t stop : {std::uint64_t{3}, end - 1, end}) {
    auto first = patient(2);
    go_on(first, stop);
    auto second = patient(2);
    second.restore(parse_checkpoint(checkpoint_bytes(first.checkpoint()), "saved"));
    to_the_end(second);
    EXPECT_EQ(second.steps(), end);
    EXPECT_EQ(policy_bytes(second.policy()), policy_bytes(whole.policy()));
  }
  auto more = patient(3);  // whoever has more patience goes on
  more.restore(whole.checkpoint());
  EXPECT_FALSE(more.finished());
  more.step();
  auto less = patient(2);
  expect_error<UsageError>([&] { less.restore(more.checkpoint()); },
                           "with a patience of 2 this run ends at step " + std::to_string(end));
  EXPECT_FALSE(run_of(end).stopped_early());
}

TEST(TrainingRun, RefusesTheCheckpointsOfOtherRuns) {
  auto run = run_of();
  go_on(run, 5);
  const auto checkpoint = run.checkpoint();
  auto other = run_of(10, 1, "seed = 2\n");
  expect_error<UsageError>([&] { other.restore(checkpoint); }, "seed = 1 there, 2 here");
  auto shorter = run_of(4);
  expect_error<UsageError>([&] { shorter.restore(checkpoint); }, "at step 5, beyond the last, 4");
  auto foreign = checkpoint;
  foreign.training.parameters.pop_back();
  expect_error<UsageError>([&] { run.restore(foreign); }, "another network");
}

}  // namespace
}  // namespace folk::sct
