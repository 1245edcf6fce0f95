#include <folk/analysis/pictures/invasion_drawing.h>
#include <folk/analysis/pictures/invasion_matrix.h>
#include <folk/analysis/pictures/invasion_picture.h>
#include <folk/analysis/pictures/plots.h>
#include <folk/strategies/registry.h>

#include <gtest/gtest.h>

#include "games/expect_error.h"
#include "games/has.h"

namespace folk {
namespace {

using test::expect_error;
using test::has;

Tournament played(const std::string& roster) {
  TournamentSettings settings;
  settings.criterion = Criterion::finite(20);
  return play_tournament(Registry::standard().roster(roster, settings.payoffs), settings);
}

std::vector<std::string> roster_names(const Tournament& tournament) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < tournament.size(); ++i) names.push_back(tournament.name(i));
  return names;
}

std::string matrix_of(const Tournament& tournament) {
  return invasion_matrix_script(Invasions(tournament), roster_names(tournament), "Who can invade whom",
                                {"game", "mean", 0}, PictureFormat::svg);
}

TEST(InvasionMatrix, TheStableComeFirst) {
  const Invasions invasions(played("all_c,all_d,tit_for_tat"));
  // all_d is evolutionarily, tit_for_tat neutrally stable, all_c invaded.
  EXPECT_EQ(invasion_order(invasions), (std::vector<std::size_t>{1, 2, 0}));
}

TEST(InvasionMatrix, OfTheInvadedThoseWithFewInvadersComeFirst) {
  const Invasions invasions(played("memory(1,1)"));
  const auto order = invasion_order(invasions);
  ASSERT_EQ(order.size(), invasions.size());
  for (std::size_t i = 1; i < order.size(); ++i)
    if (invasions.stability(order[i - 1]) == invasions.stability(order[i])) {
      EXPECT_LE(invasions.mutants(order[i - 1], Invasion::strictly).size(),
                invasions.mutants(order[i], Invasion::strictly).size());
    }
}

TEST(InvasionMatrix, ARowInvadesAColumn) {
  const std::string script = matrix_of(played("all_c,all_d,tit_for_tat"));
  EXPECT_TRUE(has(script, "set ytics ('all_d' 0, 'tit_for_tat' 1, 'all_c' 2)"));
  EXPECT_TRUE(has(script, "'mutant'") && has(script, "'resident'"));
  EXPECT_TRUE(has(script, "\n1.5 2.5 0 0xb2182b\n"));   // all_d invades all_c strictly
  EXPECT_TRUE(has(script, "\n-0.5 0.5 2 0xf3f3f3\n"));  // all_c is resisted by all_d
  EXPECT_TRUE(has(script, "\n0.5 1.5 2 0xf4a582\n"));   // and drifts into tit_for_tat
  EXPECT_FALSE(has(script, "\n-0.5 0.5 0 "));           // nobody invades itself
}

TEST(InvasionMatrix, SaysWhatItsColoursMean) {
  const std::string script = matrix_of(played("all_c,all_d,tit_for_tat"));
  for (const char* words : {"invades strictly", "weakly: drifts in", "is resisted", "evolutionarily stable",
                            "neutrally stable", "'invaded'", "'game · mean · Folk "})
    EXPECT_TRUE(has(script, words)) << words;
  EXPECT_FALSE(has(script, "undecided"));
}

TEST(InvasionMatrix, OfManyStrategiesRunsOfAColourAreOne) {
  const auto tournament = played("periodic(6)");
  ASSERT_GT(tournament.size(), 60U);
  const std::string script = matrix_of(tournament);
  const auto lines = static_cast<std::size_t>(std::count(script.begin(), script.end(), '\n'));
  EXPECT_LT(lines, tournament.size() * tournament.size() / 4);
}

TEST(InvasionMatrix, RefusesWhatIsNoMatrix) {
  const auto tournament = played("all_c,all_d");
  const Invasions invasions(tournament);
  expect_error<UsageError>([&] { invasion_matrix_script(invasions, {"one"}, "", {}, PictureFormat::svg); }, "1 names");
  expect_error<UsageError>([] { require_invasion_picture(most_plotted + 1); }, "at most 300");
}

TEST(InvasionGraph, BordersMeanNothingAndNoArrowHasAColourOfTheLegend) {
  const auto tournament = played("classics");
  const std::string dot = to_dot(Invasions(tournament), roster_names(tournament), "classics", {"game", "mean", 0.1});
  // One border for all boxes, given once; each arrow one of the inks that are neither green nor blue.
  EXPECT_TRUE(has(dot, "penwidth=1.2, color=\"#444444\"]"));
  for (std::size_t at = 0; (at = dot.find("  b", at)) != std::string::npos; ++at) {
    const std::string line = dot.substr(at, dot.find('\n', at) - at);
    if (!has(line, "->")) {
      EXPECT_FALSE(has(line, " color=")) << line;
      continue;
    }
    const auto colour = line.find("color=\"#") + 8;
    const auto part = [&](std::size_t i) { return std::stoi(line.substr(colour + 2 * i, 2), nullptr, 16); };
    EXPECT_GE(part(0), part(1)) << line;
    EXPECT_TRUE(part(0) > part(2) || (part(0) == part(1) && part(1) == part(2))) << line;
  }
  EXPECT_TRUE(has(dot, "\\ngame · mean · noise 0.1 · Folk "));
}

}  // namespace
}  // namespace folk
