#include <folk/analysis/pictures/payoff_region_plot.h>
#include <folk/games/error.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "games/expect_error.h"
#include "games/has.h"

namespace folk {
namespace {

using folk::test::has;
namespace fs = std::filesystem;
using test::expect_error;

PayoffRegionPlot dilemma() {
  PayoffRegionPlot plot;
  plot.title = "A dilemma";
  plot.players = {"Ann", "Bob"};
  plot.feasible = {{0, 5}, {1, 1}, {5, 0}, {3, 3}};
  plot.individually_rational = {{1, 1}, {4.25, 1}, {3, 3}, {1, 4.25}};
  plot.equilibria = {{1, 1}, {2, 2}};
  plot.equilibria_name = "equilibria at d = 0.5";
  plot.pure_minmax = {1, 1};
  plot.mixed_minmax = {0.75, 1};
  plot.outcomes = {{"C, C", {3, 3}}, {"D, D", {1, 1}}};
  plot.dots = {{2, 2.5}, {2, 2.5}, {3, 3}};
  plot.dots_name = "3 pairs";
  return plot;
}

std::size_t lines_with(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

std::string script(const PayoffRegionPlot& plot) { return payoff_region_script(plot, PictureFormat::svg); }

TEST(PayoffRegionPlot, HoldsEverySetPointAndName) {
  const std::string text = script(dilemma());
  for (const char* part : {"'A dilemma'", "'payoff of Ann'", "'payoff of Bob'", "'equilibria at d = 0.5'", "'3 pairs'",
                           "'C, C'", "4.25 1\n", "0 5\n", "0.75 1\n"})
    EXPECT_TRUE(has(text, part)) << part;
}

// The sign of a minmax point would hide half of a name that is as close to it as others are to their points.
TEST(PayoffRegionPlot, NamesStandClearOfMinmaxSigns) {
  const std::string text = script(dilemma());
  EXPECT_TRUE(has(text, "'D, D' at first 1,1 right offset character -1.5,-0.9"));
  EXPECT_TRUE(has(text, "'C, C' at first 3,3 left offset character 0.5,0.6"));
}

TEST(PayoffRegionPlot, DotsOnOneSpotAreDrawnOnce) { EXPECT_EQ(lines_with(script(dilemma()), "\n2 2.5\n"), 1U); }

TEST(PayoffRegionPlot, SaysWhetherThereIsAnEquilibrium) {
  PayoffRegionPlot plot = dilemma();
  plot.equilibria = Polygon<double>{};
  plot.equilibria_name = "no equilibria";
  EXPECT_TRUE(has(script(plot), "'no equilibria'"));
  plot.equilibria.reset();
  EXPECT_FALSE(has(script(plot), "'no equilibria'"));
}

TEST(PayoffRegionPlot, RefusesWhatCannotBeDrawn) {
  PayoffRegionPlot plot = dilemma();
  plot.feasible.clear();
  expect_error<UsageError>([&] { script(plot); }, "needs a feasible payoff");
  plot = dilemma();
  plot.dots.push_back({NAN, 1});
  expect_error<UsageError>([&] { script(plot); }, "not finite");
  expect_error<UsageError>([] { draw(dilemma(), "region.gif"); }, "region.gif: a plot's file name ends in");
}

TEST(PayoffRegionPlot, IsDrawnWhateverTheNamesAndShapes) {
  const fs::path path = fs::path(testing::TempDir()) / ("region_" + std::to_string(::getpid()) + ".svg");
  PayoffRegionPlot point = dilemma();
  point.feasible = point.individually_rational = {{1, 1}};
  point.equilibria = Polygon<double>{};
  point.pure_minmax = point.mixed_minmax = {1, 1};
  point.dots.clear();
  PayoffRegionPlot evil = dilemma();
  for (std::string* name : {&evil.title, &evil.players[0], &evil.equilibria_name, &evil.dots_name})
    *name = "it's `date` \\ 50%d @macro <&> \xff\n";
  try {
    for (const auto& plot : {dilemma(), point, evil}) {
      draw(plot, path);
      EXPECT_GT(fs::file_size(path), 1000U);
    }
  } catch (const RendererMissing&) {
    GTEST_SKIP() << "gnuplot is not installed";
  }
  fs::remove(path);
}

}  // namespace
}  // namespace folk
