#include <folk/mpe/pictures/filmstrip.h>

#include <gtest/gtest.h>

#include <string>
#include <variant>
#include <vector>

#include "games/expect_error.h"
#include "mpe/pictures/sample_episode.h"
#include "mpe/pictures/xml_check.h"

namespace folk::mpe {
namespace {

using test::count;
using test::expect_error;
using test::sample_episode;
using test::XmlCheck;

constexpr const char* panel = "fill=\"#f1f1f1\"";

TEST(Filmstrip, ShowsTheFirstTheLastAndStepsBetween) {
  const std::string svg = filmstrip_svg(sample_episode(), 3);
  EXPECT_EQ(XmlCheck::fault(svg), "");
  EXPECT_EQ(count(svg, panel), 3U);
  for (const char* caption : {">step 0: return 0.0<", ">step 3: return 29.0<", ">step 5: return 27.0<"})
    EXPECT_EQ(count(svg, caption), 1U) << caption;
  EXPECT_EQ(count(svg, ">step "), 3U);
  EXPECT_EQ(count(svg, "<animate"), 0U);
}

TEST(Filmstrip, RingsAreInTheFramesOfContact) {
  const auto rings = [](const EpisodeRecord& record) {
    return count(filmstrip_svg(record, 6), "fill=\"none\" stroke=\"#f0e442\"");
  };
  EpisodeRecord record = sample_episode();
  EXPECT_EQ(rings(record), 5U);  // two at step 2, three at step 3
  record.rows[3].state.positions[1] = {0.5, 0.5};
  EXPECT_EQ(rings(record), 4U);
}

TEST(Filmstrip, ContactsBetweenFramesLeaveTheirDots) {
  // Frames 0 and 5 only: the dots of steps 2 and 3 in the latter, and one in the legend.
  EXPECT_EQ(count(filmstrip_svg(sample_episode(), 2), "fill=\"#f0e442\""), 3U);
}

TEST(Filmstrip, ShortEpisodesHaveFewerFramesLongStripsMoreRows) {
  EXPECT_EQ(count(filmstrip_svg(sample_episode(), 60), panel), 6U);
  EpisodeRecord record = sample_episode();
  const Picture one_row = draw_filmstrip(record, 6);
  record.rows.insert(record.rows.end(), 7, record.rows.back());
  const Picture three_rows = draw_filmstrip(record, 13);
  EXPECT_EQ(one_row.width, three_rows.width);
  EXPECT_GT(three_rows.height, 2 * one_row.height);
  std::vector<Path> panels;
  for (const auto& shape : three_rows.shapes)
    if (const auto* path = std::get_if<Path>(&shape); path && path->fill && path->fill->colour == "#f1f1f1")
      panels.push_back(*path);
  ASSERT_EQ(panels.size(), 13U);
  EXPECT_EQ(panels[6].corners[0].x, panels[0].corners[0].x);
  EXPECT_GT(panels[6].corners[0].y, panels[0].corners[2].y);
  EXPECT_GT(panels[1].corners[0].x, panels[0].corners[2].x);
  record.rows.resize(1);
  EXPECT_EQ(count(filmstrip_svg(record), panel), 1U);
}

TEST(Filmstrip, EverythingIsInsideThePicture) {
  EpisodeRecord record = sample_episode();
  record.rows[5].state.positions[3] = {100, -100};
  record.rows[5].state.positions[0] = {-100, 100};
  for (const std::size_t frames : {2U, 6U}) {
    const Picture picture = draw_filmstrip(record, frames);
    for (const auto& shape : picture.shapes)
      if (const auto* circle = std::get_if<Circle>(&shape)) {
        EXPECT_GE(circle->centre.x, circle->radius);
        EXPECT_LE(circle->centre.x + circle->radius, picture.width);
        EXPECT_GE(circle->centre.y, circle->radius);
        EXPECT_LE(circle->centre.y + circle->radius, picture.height);
      }
  }
}

TEST(Filmstrip, RefusesAStripOfNothing) {
  for (const std::size_t frames : {0U, 1U, 61U})
    expect_error<UsageError>([&] { filmstrip_svg(sample_episode(), frames); }, "ask for 2 to 60");
  EpisodeRecord record = sample_episode();
  record.rows.clear();
  expect_error<UsageError>([&] { filmstrip_svg(record); }, "there is no step in it");
}

}  // namespace
}  // namespace folk::mpe
