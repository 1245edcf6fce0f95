#pragma once
// The arena and what is in it, as shapes: the one visual language of all pictures of an episode.

#include <folk/mpe/pictures/display_list.h>
#include <folk/mpe/pictures/film.h>

#include <cstddef>
#include <string_view>
#include <vector>

namespace folk::mpe {

/// The part of the plane that a picture shows, and where: the arena [-1, 1]^2 and everything that happens, but nothing
/// further than 3 from the centre. What is beyond is shown at the edge.
class ArenaView {
public:
  /// As large as fits into so many pixels.
  ArenaView(const Film& film, double most_width, double most_height);

  double width() const { return scale_ * (high_.x - low_.x); }
  double height() const { return scale_ * (high_.y - low_.y); }
  double scale() const { return scale_; }   ///< pixels a unit
  Point corner() const { return corner_; }  ///< its top left one

  /// The same part of the plane at another place on the picture.
  ArenaView moved_to(Point corner) const;

  /// Where a disc of this radius is drawn.
  Point place(const Point& position, double radius) const;

  /// Whether it is beyond the edge.
  bool beyond(const Point& position, double radius) const;

private:
  Point clamped(const Point& position, double radius) const;

  Point low_;
  Point high_;
  Point corner_;
  double scale_ = 1;
};

/// The background, the arena and its landmarks.
std::vector<Shape> draw_ground(const Film& film, const ArenaView& view);

/// Where an agent is in each frame up to frame `last`.
std::vector<Point> trail(const Film& film, const ArenaView& view, std::size_t agent, std::size_t last);

/// Up to frame `last`: where the agents began and their trails; and a dot wherever the prey was touched.
std::vector<Shape> draw_trails(const Film& film, const ArenaView& view, std::size_t last);
std::vector<Shape> draw_touches(const Film& film, const ArenaView& view, std::size_t last);

/// How much of its colour an agent keeps that is beyond the edge.
inline constexpr double beyond_opacity = 0.45;

/// An agent at a place on the picture; paler where it stands for one beyond the edge. Predators bear their numbers
/// where there is room.
std::vector<Shape> draw_agent(const Film& film, const ArenaView& view, std::size_t agent, const Point& centre,
                              bool beyond = false);

/// The ring around an agent in contact.
std::vector<Shape> draw_contact(const Film& film, const ArenaView& view, std::size_t agent, const Point& centre);

/// One frame: all of the above.
std::vector<Shape> draw_frame(const Film& film, const ArenaView& view, std::size_t frame);

/// The colour of an entity, and of an agent's trail.
std::string_view colour_of(const Scenario& scenario, std::size_t entity);

/// A landmark of this role, and a dot where the prey was touched: on the map and in the legend.
std::vector<Shape> draw_landmark(Role role, const Point& centre, double radius);
std::vector<Shape> draw_touch(const Point& centre);

/// The line around the arena.
Paint arena_line();

}  // namespace folk::mpe
