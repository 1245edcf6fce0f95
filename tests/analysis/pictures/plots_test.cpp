#include <folk/analysis/pictures/plots.h>
#include <folk/games/error.h>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "games/has.h"

namespace folk {
namespace {

using folk::test::has;
namespace fs = std::filesystem;

const std::vector<std::string> three{"gradual", "tit_for_tat", "all_d"};

HeatMap small_map() {
  return {three,
          [](std::size_t row, std::size_t column) { return static_cast<double>(10 * row + column) + 0.25; },
          "Scores",
          "points",
          {}};
}

BoxPlot small_boxes() {
  return {three, [](std::size_t row, std::size_t column) { return static_cast<double>(row + column); }, "Means",
          "mean"};
}

std::vector<std::string> evil_names() {
  return {"it's",
          "50%d",
          "back\\slash",
          "`date`",
          "under_score^2{x}",
          "@macro $x",
          "<&>\"",
          "é≤…",
          "a\nb\tc",
          "stray \xff\xc3 bytes",
          std::string(200, 'w'),
          ""};
}

/// A folder of this test's own that goes away with it.
class Folder {
public:
  Folder() { fs::create_directories(path_); }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  fs::path operator/(const std::string& name) const { return path_ / name; }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(path_), fs::directory_iterator()));
  }

private:
  fs::path path_ = fs::path(testing::TempDir()) / ("plots_test_" + std::to_string(::getpid()));
};

std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// False, and the test is skipped, on a machine without gnuplot.
bool gnuplot_is_there() {
  try {
    run_renderer({"gnuplot", "--version"}, "", "gnuplot-nox");
    return true;
  } catch (const RendererMissing&) {
    return false;
  }
}

// ---- Scripts -------------------------------------------------------------------------------------------------------

TEST(HeatMap, script_holds_every_name_and_value) {
  const std::string script = heat_map_script(small_map(), PictureFormat::svg);
  for (const auto& name : three) EXPECT_TRUE(has(script, "'" + name + "'")) << name;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      EXPECT_TRUE(has(script, std::to_string(j) + " " + std::to_string(i) + " " + std::to_string(10 * i + j) + ".25 "));
  EXPECT_TRUE(has(script, "'Scores'"));
  EXPECT_TRUE(has(script, "'points'"));
}

TEST(HeatMap, numbers_stand_in_the_cells_of_a_small_one_only) {
  const auto sized = [](std::size_t n) {
    HeatMap map = small_map();
    map.names.assign(n, "name");
    return heat_map_script(map, PictureFormat::png);
  };
  EXPECT_TRUE(has(sized(most_numbered), "with labels"));
  EXPECT_FALSE(has(sized(most_numbered + 1), "with labels"));
  EXPECT_TRUE(has(sized(100), "with image"));
}

TEST(HeatMap, whole_numbers_are_written_whole) {
  HeatMap map = small_map();
  map.value = [](std::size_t, std::size_t) { return 300.0; };
  EXPECT_TRUE(has(heat_map_script(map, PictureFormat::svg), " 300\n"));
  EXPECT_FALSE(has(heat_map_script(map, PictureFormat::svg), "300.0"));
}

TEST(HeatMap, what_was_not_played_is_no_number) {
  for (const std::size_t n : {3U, 30U, 100U}) {
    HeatMap map = small_map();
    map.names.assign(n, "name");
    map.value = [](std::size_t i, std::size_t j) { return i == j ? std::nan("") : i > j ? INFINITY : 1.0; };
    for (const auto format : {PictureFormat::svg, PictureFormat::png, PictureFormat::pdf}) {
      const std::string script = heat_map_script(map, format);
      EXPECT_FALSE(has(script, "nan") || has(script, "inf") || has(script, "NaN"));
    }
  }
}

TEST(HeatMap, a_given_range_is_kept) {
  HeatMap map = small_map();
  map.range = {0, 1};
  EXPECT_TRUE(has(heat_map_script(map, PictureFormat::svg), "set cbrange [0:1]"));
  map.range = {0, std::nan("")};
  EXPECT_THROW(heat_map_script(map, PictureFormat::svg), UsageError);
  for (const auto& wrong :
       {std::array<double, 2>{1, 1}, std::array<double, 2>{2, 1}, std::array<double, 2>{0, INFINITY}}) {
    map.range = wrong;
    EXPECT_THROW(heat_map_script(map, PictureFormat::svg), UsageError);
  }
}

TEST(HeatMap, says_where_values_lie_beyond_its_range) {
  HeatMap map = small_map();
  map.range = {0, 23};
  EXPECT_FALSE(has(heat_map_script(map, PictureFormat::svg), "beyond"));
  map.range = {0, 22.25 - 1e-12};  // a rounding of the largest value
  EXPECT_FALSE(has(heat_map_script(map, PictureFormat::svg), "beyond"));
  map.range = {0, 22};
  EXPECT_TRUE(has(heat_map_script(map, PictureFormat::svg), "'beyond the scale: the colour of its end'"));
}

TEST(Plots, captions_stand_in_every_script) {
  HeatMap map = small_map();
  map.caption = {"chicken", "mean", 0.5};
  EXPECT_TRUE(has(heat_map_script(map, PictureFormat::svg), "'chicken · mean · noise 0.5 · Folk "));
  BoxPlot boxes = small_boxes();
  boxes.caption = map.caption;
  EXPECT_TRUE(has(box_plot_script(boxes, PictureFormat::svg), "'chicken · mean · noise 0.5 · Folk "));
}

TEST(HeatMap, one_value_throughout_still_has_a_range) {
  HeatMap map = small_map();
  map.value = [](std::size_t, std::size_t) { return 3.0; };
  EXPECT_TRUE(has(heat_map_script(map, PictureFormat::svg), "set cbrange [2.5:3.5]"));
}

TEST(Plots, sizes_are_limited) {
  HeatMap map = small_map();
  map.names.clear();
  EXPECT_THROW(heat_map_script(map, PictureFormat::svg), UsageError);
  map.names.assign(most_plotted, "name");
  EXPECT_NO_THROW(heat_map_script(map, PictureFormat::svg));
  map.names.emplace_back("one more");
  EXPECT_THROW(heat_map_script(map, PictureFormat::svg), UsageError);
  BoxPlot boxes = small_boxes();
  boxes.names = map.names;
  EXPECT_THROW(box_plot_script(boxes, PictureFormat::svg), UsageError);
}

TEST(BoxPlot, script_holds_every_name_and_box) {
  const std::string script = box_plot_script(small_boxes(), PictureFormat::svg);
  for (const auto& name : three) EXPECT_TRUE(has(script, "'" + name + "'")) << name;
  EXPECT_TRUE(has(script, "\n0 1 1 0.5 1.5 0 2\n"));
  EXPECT_TRUE(has(script, "\n2 3 3 2.5 3.5 2 4\n"));
}

TEST(Plots, nothing_in_a_name_is_code) {
  HeatMap map = small_map();
  map.names = evil_names();
  map.title = "it's `date` 100%d";
  const std::string script = heat_map_script(map, PictureFormat::svg);
  EXPECT_TRUE(has(script, "'it''s `date` 100%d'"));
  EXPECT_TRUE(has(script, "'50%%d'"));
  EXPECT_TRUE(has(script, "'it''s'"));
  EXPECT_TRUE(has(script, "'back\\slash'"));
  EXPECT_TRUE(has(script, "'a b c'"));
  EXPECT_TRUE(has(script, "'stray ?? bytes'"));
  EXPECT_TRUE(has(script, "'é≤…'"));
  EXPECT_FALSE(has(script, std::string(33, 'w')));
}

RC_GTEST_PROP(Plots, every_name_is_one_quoted_string, (const std::string& name)) {
  HeatMap map = small_map();
  map.names = {"END", name};
  map.title = name;
  const std::string script = heat_map_script(map, PictureFormat::svg);
  const auto begin = script.find("set label '") + 10;
  const std::string line = script.substr(begin, script.find('\n', begin) - begin);
  // Quotes come in pairs, and the string ends where the position begins.
  const auto end = line.rfind("' at screen");
  RC_ASSERT(end != std::string::npos);
  const std::string inside = line.substr(1, end - 1);
  for (std::size_t i = 0; i < inside.size(); ++i)
    if (inside[i] == '\'') {
      RC_ASSERT(i + 1 < inside.size() && inside[i + 1] == '\'');
      ++i;
    }
}

// ---- Files ---------------------------------------------------------------------------------------------------------

TEST(Plots, extension_says_the_format) {
  EXPECT_THROW(draw(small_map(), "map.jpg"), UsageError);
  EXPECT_THROW(draw(small_boxes(), "map"), UsageError);
}

TEST(Plots, gnuplot_draws_every_kind) {
  if (!gnuplot_is_there()) GTEST_SKIP() << "gnuplot is not installed";
  const Folder folder;
  HeatMap map = small_map();
  map.names = evil_names();
  BoxPlot boxes = small_boxes();
  boxes.names = evil_names();
  draw(map, folder / "map.svg");
  draw(map, folder / "it's a |map.png");
  draw(boxes, folder / "boxes.svg");
  draw(boxes, folder / "boxes.png");
  draw(boxes, folder / "boxes.pdf");
  EXPECT_EQ(folder.files(), 5U);
  const std::string svg = content(folder / "map.svg");
  EXPECT_TRUE(has(svg, "</svg>"));
  EXPECT_TRUE(has(svg, "<title>Scores</title>"));
  EXPECT_FALSE(has(svg, "<title>Gnuplot</title>"));
  EXPECT_TRUE(has(svg, "<text>it's</text>"));
  EXPECT_TRUE(has(svg, "<text>50%d</text>"));
  EXPECT_TRUE(has(svg, "<text>`date`</text>"));
  EXPECT_TRUE(has(svg, "&lt;&amp;"));
  EXPECT_EQ(content(folder / "it's a |map.png").substr(1, 3), "PNG");
  EXPECT_EQ(content(folder / "boxes.pdf").substr(1, 3), "PDF");
}

TEST(Plots, gnuplot_draws_what_has_few_points_or_many) {
  if (!gnuplot_is_there()) GTEST_SKIP() << "gnuplot is not installed";
  const Folder folder;
  HeatMap map = small_map();
  BoxPlot boxes = small_boxes();
  for (const std::size_t n : {1U, 2U, 61U}) {
    map.names.assign(n, "name");
    boxes.names = map.names;
    for (const auto& name : {"few.svg", "few.png"}) {
      const auto not_oneself = [](std::size_t i, std::size_t j) { return i == j ? std::nan("") : 1.0; };
      map.value = boxes.value = not_oneself;
      EXPECT_NO_THROW(draw(map, folder / name)) << n;
      EXPECT_NO_THROW(draw(boxes, folder / name)) << n;
      map.value = boxes.value = [](std::size_t, std::size_t) { return -0.0; };
      EXPECT_NO_THROW(draw(map, folder / name)) << n;
      EXPECT_NO_THROW(draw(boxes, folder / name)) << n;
    }
  }
}

TEST(Plots, the_same_map_is_the_same_file) {
  if (!gnuplot_is_there()) GTEST_SKIP() << "gnuplot is not installed";
  const Folder folder;
  draw(small_map(), folder / "one.svg");
  draw(small_map(), folder / "two.svg");
  EXPECT_EQ(content(folder / "one.svg"), content(folder / "two.svg"));
}

TEST(Plots, a_failure_leaves_no_file) {
  if (!gnuplot_is_there()) GTEST_SKIP() << "gnuplot is not installed";
  EXPECT_THROW(draw(small_map(), "no/such/folder/map.svg"), EnvironmentError);
  const Folder folder;
  fs::create_directory(folder / "map.svg");
  EXPECT_THROW(draw(small_map(), folder / "map.svg"), EnvironmentError);
  EXPECT_EQ(folder.files(), 1U);
}

}  // namespace
}  // namespace folk
