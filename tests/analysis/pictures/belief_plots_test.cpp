#include <folk/analysis/pictures/belief_plots.h>
#include <folk/analysis/pictures/plots.h>
#include <folk/games/error.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "games/expect_error.h"
#include "games/has.h"

namespace folk {
namespace {

using folk::test::has;
namespace fs = std::filesystem;
using test::expect_error;

/// The lines of a block of data.
std::string block(const std::string& script, const std::string& name) {
  const std::string opening = "$" + name + " << END_OF_" + name + "\n";
  const auto begin = script.find(opening);
  if (begin == std::string::npos) return {};
  const auto from = begin + opening.size();
  return script.substr(from, script.find("END_OF_" + name + "\n", from) - from);
}

BeliefPathPlot three_rounds() {
  return {{{Move::C, Move::C, 0.75, 1}, {Move::C, Move::D, 0.5, 0}, {Move::D, Move::D, 0.25, 0}}, "Beliefs"};
}

AccuracyPlot three_opponents() { return {{"all_d", "nobody", "pavlov"}, {0.5, std::nullopt, 1}, "Accuracy"}; }

CalibrationPlot two_bins() {
  CalibrationPlot plot;
  plot.bins[1] = {4, 0.5, 1};
  plot.bins[9] = {12345, 12000, 12345};
  plot.title = "Calibration";
  return plot;
}

std::string script(const BeliefPathPlot& plot) { return belief_path_script(plot, PictureFormat::svg); }
std::string script(const AccuracyPlot& plot) { return accuracy_script(plot, PictureFormat::svg); }
std::string script(const CalibrationPlot& plot) { return calibration_script(plot, PictureFormat::svg); }

TEST(BeliefPathPlot, MovesAreMarkedByWhetherTheyWereBelieved) {
  const std::string text = script(three_rounds());
  EXPECT_EQ(block(text, "BELIEFS"), "1 0.75\n2 0.5\n3 0.25\n");
  EXPECT_EQ(block(text, "RIGHT"), "1 1\n3 0\n");
  EXPECT_EQ(block(text, "WRONG"), "2 0\n");  // at even odds C is held likelier
  EXPECT_TRUE(has(text, "'Beliefs'"));
}

TEST(BeliefPathPlot, TheTruthIsDrawnOfAnOpponentThatMixes) {
  EXPECT_EQ(block(script(three_rounds()), "TRUTHS"), "");
  BeliefPathPlot plot = three_rounds();
  plot.match[1].truth = 0.3;
  EXPECT_EQ(block(script(plot), "TRUTHS"), "1 1\n2 0.3\n3 0\n");
}

TEST(BeliefPathPlot, TheLineBreaksWhereNothingWasBelieved) {
  BeliefPathPlot plot = three_rounds();
  plot.match[1].belief.reset();
  EXPECT_EQ(block(script(plot), "BELIEFS"), "1 0.75\n\n3 0.25\n");
  EXPECT_EQ(block(script(plot), "WRONG"), "");
  for (auto& round : plot.match) round.belief.reset();
  EXPECT_FALSE(has(script(plot), "$BELIEFS"));
}

TEST(BeliefPathPlot, LongMatchesAreCut) {
  BeliefPathPlot plot{BeliefMatch(most_drawn_rounds + 1, {Move::C, Move::C, 1, 1}), "Long"};
  EXPECT_TRUE(has(block(script(plot), "BELIEFS"), std::to_string(most_drawn_rounds) + " 1\n"));
  EXPECT_FALSE(has(block(script(plot), "BELIEFS"), std::to_string(most_drawn_rounds + 1) + " 1\n"));
}

TEST(AccuracyPlot, HoldsEveryNameAndShare) {
  const std::string text = script(three_opponents());
  for (const char* name : {"'all_d' 0", "'nobody' 1", "'pavlov' 2"}) EXPECT_TRUE(has(text, name)) << name;
  EXPECT_EQ(block(text, "BARS"), "0 50 \"50.0 %\"\n2 100 \"100.0 %\"\n");
}

TEST(CalibrationPlot, HoldsEveryBinThatIsNotEmpty) {
  const std::string bins = block(script(two_bins()), "BINS");
  EXPECT_TRUE(has(bins, "0.125 0.25 "));
  EXPECT_TRUE(has(bins, " 4 "));
  EXPECT_TRUE(has(bins, " 1 2.100 12k "));  // the largest dot
  EXPECT_FALSE(has(script(CalibrationPlot{}), "$BINS"));
}

TEST(BeliefPlots, RefuseWhatIsNoPicture) {
  expect_error<UsageError>([] { script(BeliefPathPlot{}); }, "needs a round");
  BeliefPathPlot path = three_rounds();
  path.match[0].belief = std::nan("");
  expect_error<UsageError>([&] { script(path); }, "belief is no probability");
  path = three_rounds();
  path.match[0].truth = 1.5;
  expect_error<UsageError>([&] { script(path); }, "truth is no probability");
  expect_error<UsageError>([] { script(AccuracyPlot{}); }, "at least one");
  AccuracyPlot accuracy = three_opponents();
  accuracy.shares.pop_back();
  expect_error<UsageError>([&] { script(accuracy); }, "3 opponents and 2 accuracies");
  accuracy.names.assign(most_plotted + 1, "name");
  expect_error<UsageError>([&] { script(accuracy); }, "too many");
  CalibrationPlot calibration = two_bins();
  calibration.bins[1].belief_sum = -1;
  expect_error<UsageError>([&] { script(calibration); }, "belief is no probability");
  expect_error<UsageError>([] { draw(three_rounds(), "a.gif"); }, "ends in .svg");
  expect_error<UsageError>([] { draw(three_rounds(), std::string(5000, 'a')); }, "aaa...: a plot's file name");
}

RC_GTEST_PROP(BeliefPlots, NothingInANameIsCode, (const std::string& name)) {
  AccuracyPlot plot = three_opponents();
  plot.names[1] = name;
  plot.title = name;
  const std::string text = script(plot);
  const auto begin = text.find("set ytics ('all_d' 0, ") + 22;
  const std::string line = text.substr(begin, text.find('\n', begin) - begin);
  const auto end = line.rfind("' 1, 'pavlov' 2)");
  RC_ASSERT(line[0] == '\'');
  RC_ASSERT(end != std::string::npos);
  // Quotes inside come in pairs.
  for (std::size_t i = 1; i < end; ++i)
    if (line[i] == '\'') RC_ASSERT(line[++i] == '\'');
}

TEST(BeliefPlots, GnuplotDrawsThem) {
  const fs::path folder = fs::path(testing::TempDir()) / ("belief_plots_test_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  try {
    AccuracyPlot hostile = three_opponents();
    hostile.names = {"it's `date`", "50%d <&>\"", "exec:\"rm -rf\n$x\""};
    hostile.title = "it's '; system('date')";
    draw(hostile, folder / "accuracy.svg");
    draw(AccuracyPlot{{"nobody"}, {std::nullopt}, "No beliefs"}, folder / "none.svg");
    draw(three_rounds(), folder / "path.svg");
    draw(two_bins(), folder / "calibration.svg");
    draw(CalibrationPlot{}, folder / "empty.svg");
    std::ifstream file(folder / "accuracy.svg");
    const std::string svg((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    EXPECT_TRUE(has(svg, "it's `date`"));
    EXPECT_TRUE(has(svg, "50%d &lt;&amp;"));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 5);
  } catch (const RendererMissing&) {
    fs::remove_all(folder);
    GTEST_SKIP() << "gnuplot is not installed";
  }
  fs::remove_all(folder);
}

}  // namespace
}  // namespace folk
