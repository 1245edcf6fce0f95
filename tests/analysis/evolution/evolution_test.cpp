// The way of a population: how it ends, what is told of it, where its members rank.

#include "analysis/evolution/some_scores.h"
#include "games/ended_work.h"
#include "games/expect_error.h"

#include <folk/analysis/evolution/evolution.h>
#include <folk/analysis/evolution/finite_population.h>
#include <folk/analysis/evolution/fixation.h>
#include <folk/analysis/evolution/integer_selection.h>
#include <folk/analysis/evolution/simulated_fixation.h>
#include <folk/analysis/evolution/small_mutations.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

namespace folk {
namespace {

using test::scores_of;

/// Goes through so many populations once, then round and round through others.
class Roundabout : public Dynamics {
public:
  Roundabout(int before, int around)
      : before_(before),
        around_(around) {}

  void advance(Population& now, RandomStream&) const override {
    now[0] = now[0] < before_ + around_ - 1 ? now[0] + 1 : before_;
  }
  bool is_random() const override { return false; }
  bool stays_uniform() const override { return false; }
  std::string text() const override { return "roundabout"; }

private:
  int before_;
  int around_;
};

RC_GTEST_PROP(Evolution, FindsCyclesAndHowLongTheyAre, ()) {
  const int before = *rc::gen::inRange(0, 50);
  const int around = *rc::gen::inRange(1, 50);
  Evolution evolution(std::make_shared<Roundabout>(before, around), {0, 1});
  evolution.run(100000);
  if (around == 1) {
    RC_ASSERT(evolution.state().end == EvolutionEnd::fixed_point);
    RC_ASSERT(evolution.state().generation == static_cast<std::uint64_t>(before) + 1);
  } else {
    RC_ASSERT(evolution.state().end == EvolutionEnd::cycle);
    RC_ASSERT(evolution.state().period == static_cast<std::uint64_t>(around));
    RC_ASSERT(evolution.state().generation <= 4 * static_cast<std::uint64_t>(before + around));
  }
}

TEST(Evolution, RanksTheLivingByNumberAndTheDeadByTheirEnd) {
  const auto scores = scores_of("all_c,all_d,tit_for_tat,per_ddc,spiteful", 100);
  Population start(5, 100);
  start[4] = 0;
  Evolution evolution(std::make_shared<IntegerSelection>(scores, start), start);
  evolution.run(1000);
  const auto ranking = evolution.ranking();
  EXPECT_EQ(ranking.back().entrant, 4U);  // it was never there
  EXPECT_EQ(ranking.back().extinct_at, 0U);
  for (std::size_t r = 1; r < ranking.size(); ++r) {
    EXPECT_EQ(ranking[r].rank, r + 1);
    EXPECT_GE(ranking[r - 1].population, ranking[r].population);
    if (!ranking[r - 1].extinct_at || !ranking[r].extinct_at) continue;
    EXPECT_GE(*ranking[r - 1].extinct_at, *ranking[r].extinct_at);
  }
}

TEST(Evolution, TellsItsProgressAndEndsAsItWishes) {
  const auto scores = scores_of("all_c,all_d,tit_for_tat", 10);
  const Population start{5, 5, 5};
  const SelectionRules rules{Process::birth_death, Fitness::linear, Rational(1, 10), false};
  const auto model = std::make_shared<FinitePopulation>(scores, start, rules, 0.1);
  test::expect_ends([&](const Progress& progress) {
    Evolution evolution(model, start);
    evolution.run(50, progress);
    EXPECT_EQ(evolution.state().generation, 50U);
  });
  const auto competition = std::make_shared<IntegerSelection>(scores, start);
  test::expect_ends([&](const Progress& progress) {
    Evolution evolution(competition, start);
    evolution.run(1000, progress);
    EXPECT_EQ(evolution.state().end, EvolutionEnd::fixed_point);
  });
  const FinitePopulation without(scores, start, rules);
  test::expect_ends([&](const Progress& progress) {
    FixationCounts counts;
    simulate_fixation(counts, without, start, 600, 100000, 1, 2, progress);
    EXPECT_EQ(counts.runs, 600U);
  });
  test::expect_ends([&](const Progress& progress) { fixation_probabilities(*scores, 20, rules, true, 2, progress); });
  const auto fixation = fixation_probabilities(*scores, 20, rules, true, 1);
  test::expect_ends([&](const Progress& progress) { small_mutation_distribution(fixation, progress); });
}

TEST(Evolution, IsTheSameWhenItIsCancelledAndGoneOnWith) {
  const auto scores = scores_of("classics", 20);
  const Population start(17, 10);
  const auto model = std::make_shared<FinitePopulation>(
      scores, start, SelectionRules{Process::pairwise_comparison, Fitness::linear, 1, false}, 0.01);
  Evolution whole(model, start, 3);
  whole.run(200);
  Evolution parts(model, start, 3);
  Progress cancels;
  cancels = [&](double share) {
    if (share > 0.3) cancels.cancel();
  };
  EXPECT_THROW(parts.run(200, cancels), Cancelled);
  EXPECT_LT(parts.state().generation, 200U);
  parts.run(200);
  EXPECT_EQ(parts.state().population, whole.state().population);
  EXPECT_EQ(parts.state().extinct_at, whole.state().extinct_at);
}

}  // namespace
}  // namespace folk
