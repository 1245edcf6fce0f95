// Pictures of populations: what the scripts hold, and that the programs draw them.

#include "games/expect_error.h"

#include <folk/analysis/evolution/small_mutations.h>
#include <folk/analysis/pictures/fixation_drawing.h>
#include <folk/analysis/pictures/population_plot.h>
#include <folk/analysis/pictures/simplex_plot.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace folk {
namespace {

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

PopulationPlot plot_of(std::size_t strategies, std::uint64_t generations) {
  PopulationPlot plot;
  for (std::size_t i = 0; i < strategies; ++i) {
    plot.names.push_back("s" + std::to_string(i));
    plot.ranking.push_back(strategies - 1 - i);
  }
  for (std::uint64_t g = 0; g <= generations; ++g) {
    Population population;
    for (std::size_t i = 0; i < strategies; ++i) population.push_back(static_cast<double>(i * (g + 1)));
    plot.rows.push_back({g, population});
  }
  plot.title = "it's a title";
  return plot;
}

TEST(PopulationPlot, ColoursTheMostAndCallsTheRestOthers) {
  const auto script = population_lines_script(plot_of(14, 5), PictureFormat::svg);
  EXPECT_TRUE(holds(script, "title 's13'"));
  EXPECT_TRUE(holds(script, "title 's4'"));
  EXPECT_FALSE(holds(script, "title 's3'"));
  EXPECT_TRUE(holds(script, "'4 others'"));
  EXPECT_TRUE(holds(script, "set logscale y"));
  EXPECT_FALSE(holds(script, "set logscale x"));
  EXPECT_TRUE(holds(script, "'it''s a title'"));
  EXPECT_TRUE(holds(script, "\n0 3 2 1 NaN 13"));  // the logarithm of nobody
  EXPECT_TRUE(holds(population_stack_script(plot_of(14, 5), PictureFormat::svg), "'4 others'"));
  EXPECT_FALSE(holds(population_stack_script(plot_of(3, 5), PictureFormat::svg), "others"));
  EXPECT_TRUE(holds(script, "set ytics format '%.0f'"));
  auto millions = plot_of(3, 5);
  millions.rows[2].population[1] = 2.5e6;
  EXPECT_TRUE(holds(population_lines_script(millions, PictureFormat::svg), "set ytics format '%.1s%c'"));
}

TEST(PopulationPlot, OfALongWayHasALogarithmicAxisAndFewPoints) {
  const auto script = population_stack_script(plot_of(2, 100000), PictureFormat::svg);
  EXPECT_TRUE(holds(script, "set logscale x"));
  EXPECT_LT(std::count(script.begin(), script.end(), '\n'), 1000);
  EXPECT_TRUE(holds(script, "\n1 0 "));
  EXPECT_TRUE(holds(script, "\n100000 0 "));
}

TEST(PopulationPlot, SaysWhatIsMissing) {
  test::expect_error<UsageError>([] { population_lines_script({}, PictureFormat::svg); }, "strategies and generations");
  auto plot = plot_of(3, 2);
  plot.rows[1].population.pop_back();
  test::expect_error<UsageError>([&] { population_stack_script(plot, PictureFormat::svg); }, "as many numbers");
  test::expect_error<UsageError>([] { cooperation_script({}, PictureFormat::svg); }, "needs a generation");
}

TEST(SimplexPlot, FlowsAlongTheReplicatorEquation) {
  const std::array<std::array<double, 3>, 3> payoffs{{{3, 0, 3}, {5, 1, 1}, {3, 1, 3}}};
  const auto velocity = replicator_velocity(payoffs, {0.2, 0.5, 0.3});
  EXPECT_NEAR(velocity[0] + velocity[1] + velocity[2], 0, 1e-15);
  // f = 1.5, 1.8, 2; phi = 0.3 + 0.9 + 0.6.
  EXPECT_NEAR(velocity[0], 0.2 * (1.5 - 1.8), 1e-15);
  EXPECT_NEAR(velocity[2], 0.3 * (2.0 - 1.8), 1e-15);
  const auto script = simplex_script({{"a", "b", "c"}, payoffs, {{0.2, 0.5, 0.3}}, "t"}, PictureFormat::svg);
  EXPECT_TRUE(holds(script, "$ARROWS"));
  EXPECT_TRUE(holds(script, "$RESTS"));  // the edge between the first and the third
  EXPECT_TRUE(holds(script, "$GOAL"));
  auto wrong = payoffs;
  wrong[1][1] = NAN;
  test::expect_error<UsageError>(
      [&] {
        simplex_script({{"a", "b", "c"}, wrong, {}, "t"}, PictureFormat::svg);
      },
      "not finite");
}

TEST(FixationDrawing, LeadsFromTheMutantToWhomItTakesOver) {
  const ScoreMatrix scores({"all_c", "all_d", "friend \"x\""}, {{3, 0, 3}, {5, 1, 1}, {3, 1, 3}}, 1);
  const SelectionRules rules;
  const auto fixation =
      fixation_probabilities(scores, 20, {Process::pairwise_comparison, Fitness::linear, 1, false}, false, 1);
  const auto dot = to_dot(fixation, small_mutation_distribution(fixation), scores.names(), "title");
  EXPECT_TRUE(holds(dot, "s1 -> s0 [label="));
  EXPECT_FALSE(holds(dot, "s0 -> s1"));
  EXPECT_TRUE(holds(dot, "s0 -> s2 [style=dashed, dir=both]"));
  EXPECT_TRUE(holds(dot, "friend \\\"x\\\""));
  FixationProbabilities many;
  many.strategies = most_drawn_fixations + 1;
  test::expect_error<UsageError>([&] { to_dot(many, {}, {}, ""); }, "too many");
}

}  // namespace
}  // namespace folk
