#include <folk/mpe/pictures/arena_drawing.h>
#include <folk/mpe/pictures/captions.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "mpe/pictures/sample_episode.h"

namespace folk::mpe {
namespace {

using test::sample_episode;

Film sample_film() { return film_of(sample_episode(), 100); }

/// The sample with the prey far away in the last frame.
Film film_with_prey_at(Point place) {
  EpisodeRecord record = sample_episode();
  record.rows.back().state.positions[3] = place;
  return film_of(record, 100);
}

std::vector<Circle> circles(const std::vector<Shape>& shapes) {
  std::vector<Circle> found;
  for (const auto& shape : shapes)
    if (const auto* circle = std::get_if<Circle>(&shape)) found.push_back(*circle);
  return found;
}

std::vector<Path> paths(const std::vector<Shape>& shapes) {
  std::vector<Path> found;
  for (const auto& shape : shapes)
    if (const auto* path = std::get_if<Path>(&shape)) found.push_back(*path);
  return found;
}

std::set<std::string> texts(const std::vector<Shape>& shapes) {
  std::set<std::string> found;
  for (const auto& shape : shapes)
    if (const auto* text = std::get_if<Text>(&shape)) found.insert(text->text);
  return found;
}

TEST(ArenaView, ShowsTheArenaUprightAndToScale) {
  const ArenaView view = ArenaView(sample_film(), 400, 300).moved_to({10, 20});
  EXPECT_DOUBLE_EQ(std::max(view.width() / 400, view.height() / 300), 1);
  const Point low = view.place({-1, -1}, 0);
  const Point high = view.place({1, 1}, 0);
  EXPECT_NEAR(high.x - low.x, 2 * view.scale(), 1e-9);
  EXPECT_NEAR(low.y - high.y, 2 * view.scale(), 1e-9);  // up is up
  EXPECT_GT(low.x, 10);
  EXPECT_GT(high.y, 20);
  EXPECT_LT(high.x, 10 + view.width());
  EXPECT_LT(low.y, 20 + view.height());
}

TEST(ArenaView, GrowsToHoldWhatHappensButNotWithoutEnd) {
  const Film near = film_with_prey_at({2.5, 0});
  const ArenaView near_view(near, 400, 400);
  EXPECT_FALSE(near_view.beyond({2.5, 0}, 0.05));
  EXPECT_NEAR(near_view.scale(), 400 / (2.5 + 0.05 + 1 + 0.12), 1e-9);
  const Film far = film_with_prey_at({1e300, -0.3});
  const ArenaView far_view(far, 400, 400);
  EXPECT_TRUE(far_view.beyond({1e300, -0.3}, 0.05));
  EXPECT_FALSE(far_view.beyond({0, 0.5}, 0.05));
  EXPECT_NEAR(far_view.scale(), 400 / (3 + 1 + 0.12), 1e-9);
  EXPECT_NEAR(far_view.place({1e300, -0.3}, 0.05).x, far_view.width() - 0.05 * far_view.scale(), 1e-9);
}

TEST(ArenaDrawing, LandmarksHaveTheirTrueRadiusAndColour) {
  EpisodeRecord record = sample_episode();
  record.scenario = Scenario::named("simple_world");
  for (auto& row : record.rows) row.state.positions.resize(9, Point{0.5, 0.1});
  const Film film = film_of(record, 100);
  const ArenaView view(film, 400, 400);
  std::multiset<std::string_view> colours;
  for (const auto& circle : circles(draw_ground(film, view))) {
    colours.insert(circle.fill->colour);
    const double radius = circle.radius / view.scale();
    const bool forest = circle.fill->colour == colour_of(film.scenario, 7);
    const bool food = circle.fill->colour == colour_of(film.scenario, 5);
    EXPECT_NEAR(radius, forest ? 0.3 : food ? 0.03 : 0.2, 1e-12);
  }
  EXPECT_EQ(colours.count(colour_of(film.scenario, 4)), 1U);
  EXPECT_EQ(colours.count(colour_of(film.scenario, 5)), 2U);
  EXPECT_EQ(colours.count(colour_of(film.scenario, 7)), 2U);
}

TEST(ArenaDrawing, TrailsEndAtTheFrame) {
  const Film film = sample_film();
  const ArenaView view(film, 400, 400);
  EXPECT_TRUE(paths(draw_trails(film, view, 0)).empty());
  const auto trails = paths(draw_trails(film, view, 3));
  ASSERT_EQ(trails.size(), 4U);
  for (std::size_t agent = 0; agent < 4; ++agent) {
    EXPECT_EQ(trails[agent].corners, trail(film, view, agent, 3));
    EXPECT_EQ(trails[agent].corners.size(), 4U);
    EXPECT_EQ(trails[agent].line->colour, colour_of(film.scenario, agent));
  }
}

TEST(ArenaDrawing, TouchesAreMarkedFromTheirStepOn) {
  const Film film = sample_film();
  const ArenaView view(film, 400, 400);
  const std::vector<std::size_t> marks{0, 0, 1, 2, 2, 2};
  const std::vector<std::size_t> rings{0, 0, 2, 3, 0, 0};  // of the prey and each predator that touches it
  for (std::size_t frame = 0; frame < 6; ++frame) {
    const std::size_t dots = circles(draw_touches(film, view, frame)).size();
    EXPECT_EQ(dots, marks[frame]) << frame;
    // Two landmarks, a start and a disc for each of four agents, and a ring is two circles.
    EXPECT_EQ(circles(draw_frame(film, view, frame)).size(), 2 + 8 + dots + 2 * rings[frame]) << frame;
  }
}

TEST(ArenaDrawing, NothingIsDrawnThatHappensBeyondTheEdge) {
  EpisodeRecord record = sample_episode();
  for (std::size_t step = 2; step < 5; ++step) {
    const double y = 0.1 * static_cast<double>(step);
    record.rows[step].state.positions[3] = {50, y};
    record.rows[step].state.positions[1] = {50, y + 0.05};
  }
  const Film film = film_of(record, 100);
  const ArenaView view(film, 400, 400);
  EXPECT_TRUE(circles(draw_touches(film, view, 5)).empty());
  const auto trails = paths(draw_trails(film, view, 5));  // those of predator 1 and the prey in two pieces
  ASSERT_EQ(trails.size(), 6U);
  EXPECT_EQ(trails[1].corners.size(), 3U);
  EXPECT_EQ(trails[2].corners.size(), 2U);
  const auto discs = circles(draw_agent(film, view, 3, {}, true));
  EXPECT_EQ(discs[0].fill->opacity, beyond_opacity);
}

TEST(ArenaDrawing, PredatorsBearTheirNumbersWhereThereIsRoom) {
  const Film film = sample_film();
  EXPECT_EQ(texts(draw_frame(film, ArenaView(film, 400, 400), 0)), (std::set<std::string>{"0", "1", "2"}));
  EXPECT_TRUE(texts(draw_frame(film, ArenaView(film, 100, 100), 0)).empty());
}

TEST(Captions, TheLegendNamesWhatIsThere) {
  const Film tag = sample_film();
  const auto legend = [](const Film& film) { return texts(draw_legend(film, ArenaView(film, 400, 400), {}, 200)); };
  EXPECT_EQ(legend(tag), (std::set<std::string>{"predators", "prey", "obstacle", "where they began", "prey touched",
                                                "arena [-1, 1]²"}));
  EXPECT_TRUE(legend(film_with_prey_at({9, 0})).contains("beyond the edge"));
  EpisodeRecord record = sample_episode();
  record.rows.resize(2);
  EXPECT_FALSE(legend(film_of(record, 9)).contains("prey touched"));
  record.scenario = Scenario::named("simple_world");
  for (auto& row : record.rows) row.state.positions.resize(9);
  EXPECT_TRUE(legend(film_of(record, 9)).contains("food"));
  EXPECT_TRUE(legend(film_of(record, 9)).contains("forest"));
}

TEST(Captions, TheLegendKeepsToItsWidth) {
  const Film film = sample_film();
  const ArenaView view(film, 400, 400);
  for (const double width : {10.0, 176.0, 500.0, 1300.0}) {
    double right = 0;
    for (const auto& shape : draw_legend(film, view, {}, width))
      if (const auto* text = std::get_if<Text>(&shape)) {
        right = std::max(right, text->at.x);
        EXPECT_LT(text->at.y, legend_height(film, view, width));
      }
    EXPECT_LT(right, std::max(width, 40.0));
  }
  EXPECT_LT(legend_height(film, view, 1300), legend_height(film, view, 176));
}

}  // namespace
}  // namespace folk::mpe
