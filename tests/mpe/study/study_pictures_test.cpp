#include <folk/games/error.h>
#include <folk/mpe/study/study_pictures.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "games/expect_error.h"
#include "games/has.h"
#include "mpe/study/made_up_tables.h"

namespace folk::mpe {
namespace {

using folk::test::expect_error;
using folk::test::has;
using test::made_up_second_tables;
using test::made_up_tables;

std::string script(const StudyTables& tables, const std::string& name) {
  for (const auto& picture : study_pictures(tables))
    if (picture.name == name) return picture.script(PictureFormat::svg);
  return "no picture " + name;
}

std::vector<std::string> names(const StudyTables& tables) {
  std::vector<std::string> found;
  for (const auto& picture : study_pictures(tables)) found.push_back(picture.name);
  return found;
}

TEST(StudyPictures, OnlyOfWhatWasRun) {
  EXPECT_EQ(names(made_up_tables()), (std::vector<std::string>{"scores_simple_tag", "blend_simple_tag",
                                                               "accuracy_simple_tag", "asked_simple_tag"}));
  // The paper has nothing of the second table.
  EXPECT_EQ(names(made_up_second_tables()),
            (std::vector<std::string>{"trained_prey_blend_simple_tag", "trained_prey_accuracy_simple_tag",
                                      "trained_prey_asked_simple_tag"}));
  EXPECT_TRUE(names(StudyTables{}).empty());
  EXPECT_EQ(study_picture_names(made_up_tables()).size(), 8U);
  for (const auto& tables : {made_up_tables(), made_up_second_tables()})
    for (const auto& name : names(tables)) {
      const auto all = study_picture_names(tables);
      EXPECT_NE(std::find(all.begin(), all.end(), name), all.end()) << name;
    }
}

TEST(StudyPictures, BlendsAreCurvesWithIntervals) {
  const std::string text = script(made_up_tables(), "blend_simple_tag");
  EXPECT_TRUE(has(text, "$CURVE0 << END_OF_CURVE0\n0.3 40.5 2\n1 103.25 8.25\nEND_OF_CURVE0\n")) << text;
  EXPECT_TRUE(has(text, "$CURVE1 << END_OF_CURVE1\n0.3 70 1\n1 123.5 1\nEND_OF_CURVE1\n")) << text;
  for (const char* part : {"using 1:2:3 with yerrorlines", "title 'SCT'", "title 'pursuit rule'"})
    EXPECT_TRUE(has(text, part)) << part;
  EXPECT_FALSE(has(text, "OMAR"));
  EXPECT_FALSE(has(text, "$CURVE2"));
}

TEST(StudyPictures, ScoresLieOverThePapers) {
  const std::string text = script(made_up_tables(), "scores_simple_tag");
  EXPECT_TRUE(has(text, "\n121.13 103.21349 1.63697")) << text;  // 0.198 of the deviation
  EXPECT_TRUE(has(text, "x with lines"));
  EXPECT_TRUE(has(text, "title 'SCT'"));
  EXPECT_FALSE(has(text, "MADT"));  // not in the paper
  auto other = made_up_tables();
  for (auto& row : other.scores) row.prey = "maddpg";  // whom the paper calls so is another one
  EXPECT_EQ(script(other, "scores_simple_tag"), "no picture scores_simple_tag");
}

TEST(StudyPictures, AccuraciesAreBarsWithThePapersLines) {
  const std::string text = script(made_up_tables(), "accuracy_simple_tag");
  // The second of two bars; its interval and the mark over all its width.
  EXPECT_TRUE(has(text, "\n0.200000 0.984375 0.979375 0.989375 0.360000\n")) << text;
  EXPECT_TRUE(has(text, "$MARKS << END_OF_MARKS\n0.000000 1 0.400000\nEND_OF_MARKS\n")) << text;
  EXPECT_FALSE(has(text, "RMADT"));
  EXPECT_FALSE(has(script(made_up_second_tables(), "trained_prey_accuracy_simple_tag"), "$MARKS"));
}

TEST(StudyPictures, IntervalsOfSharesEndWhereSharesDo) {
  ShareBarsPlot plot;
  plot.groups = {"still"};
  plot.kinds = {{"SCT", 0, {{Cell{0.95, 0.25, 3}, {}}}}, {"RMADT", 2, {{Cell{0.125, 0.25, 3}, {}}}}};
  const std::string text = share_bars_script(plot, PictureFormat::svg);
  EXPECT_TRUE(has(text, " 0.95 0.7 1 ")) << text;
  EXPECT_TRUE(has(text, " 0.125 0 0.375 ")) << text;
}

TEST(StudyPictures, AskedReturnsAreOfSct) {
  const std::string text = script(made_up_tables(), "asked_simple_tag");
  EXPECT_TRUE(has(text, "\n80 60 5\n")) << text;
  EXPECT_FALSE(has(text, "\n80 61 5\n")) << text;
  EXPECT_TRUE(has(text, "title 'against released'"));
}

TEST(StudyPictures, NothingOfATextIsExecuted) {
  IntervalCurvesPlot plot{"it's", "x`date`", "y", {{"a'; system 'b", 0, {{0, 1, 0}}}}};
  const std::string text = interval_curves_script(plot, PictureFormat::svg);
  EXPECT_TRUE(has(text, "'it''s'"));
  EXPECT_TRUE(has(text, "'x`date`'"));
  EXPECT_TRUE(has(text, "'a''; system ''b'"));
}

TEST(StudyPictures, RefusesWhatCannotBeDrawn) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto curves = [](const IntervalCurvesPlot& plot) {
    return [plot] { interval_curves_script(plot, PictureFormat::svg); };
  };
  expect_error<UsageError>(curves({"empty", "", "", {}}), "'empty' has nothing to draw");
  expect_error<UsageError>(curves({"curve", "", "", {{"a", 0, {}}}}), "'curve' has nothing to draw");
  expect_error<UsageError>(curves({"nan", "", "", {{"a", 0, {{0, nan, 0}}}}}), "'nan' has a number that is not finite");
  expect_error<UsageError>([&] { agreement_script({"none", {}}, PictureFormat::svg); }, "'none' has nothing to draw");
  ShareBarsPlot bars;
  bars.title = "bars";
  bars.groups = {"still", "random"};
  bars.kinds = {{"SCT", 0, {{Cell{0.5, 0, 1}, {}}}}};
  expect_error<UsageError>([&] { share_bars_script(bars, PictureFormat::svg); }, "not one bar a group");
  bars.kinds[0].bars = {{}, {}};
  expect_error<UsageError>([&] { share_bars_script(bars, PictureFormat::svg); }, "'bars' has nothing");
}

}  // namespace
}  // namespace folk::mpe
