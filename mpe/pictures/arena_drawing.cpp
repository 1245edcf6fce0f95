#include <folk/mpe/pictures/arena_drawing.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace folk::mpe {
namespace {

// The colours are those of Okabe and Ito, which colour-blind readers tell apart, and shades of them.
constexpr std::array<std::string_view, 3> predator_colours{"#d55e00", "#a23b00", "#cc8400"};
constexpr std::string_view prey_colour = "#0072b2";
constexpr std::string_view obstacle_colour = "#8f8f8f";
constexpr std::string_view food_colour = "#cc79a7";
constexpr std::string_view forest_colour = "#009e73";
constexpr std::string_view touch_colour = "#f0e442";
constexpr std::string_view dark = "#222222";

constexpr double furthest_shown = 3;
constexpr double room = 0.06;  // around everything

/// An agent with fewer pixels of radius bears no number.
constexpr double least_numbered_radius = 5.5;

bool is_beyond(const Film& film, const ArenaView& view, std::size_t agent, std::size_t frame) {
  return view.beyond(film.frames[frame].positions[agent], film.scenario.entities[agent].radius);
}

/// A trail without the moves that lie beyond the edge from beginning to end.
std::vector<std::vector<Point>> pieces_in_view(const Film& film, const ArenaView& view, std::size_t agent,
                                               std::size_t last) {
  const auto places = trail(film, view, agent, last);
  std::vector<std::vector<Point>> pieces;
  for (std::size_t i = 1; i <= last; ++i) {
    if (is_beyond(film, view, agent, i - 1) && is_beyond(film, view, agent, i)) continue;
    if (pieces.empty() || pieces.back().back() != places[i - 1]) pieces.push_back({places[i - 1]});
    pieces.back().push_back(places[i]);
  }
  return pieces;
}

}  // namespace

std::string_view colour_of(const Scenario& scenario, std::size_t entity) {
  switch (scenario.entities[entity].role) {
    case Role::predator: return predator_colours[entity % predator_colours.size()];
    case Role::prey: return prey_colour;
    case Role::obstacle: return obstacle_colour;
    case Role::food: return food_colour;
    case Role::forest: break;
  }
  return forest_colour;
}

Paint arena_line() { return {"#555555", 1}; }

ArenaView::ArenaView(const Film& film, double most_width, double most_height)
    : low_{-1, -1},
      high_{1, 1} {
  for (const auto& frame : film.frames)
    for (std::size_t i = 0; i < frame.positions.size(); ++i) {
      const double radius = film.scenario.entities[i].radius;
      low_ = {std::min(low_.x, frame.positions[i].x - radius), std::min(low_.y, frame.positions[i].y - radius)};
      high_ = {std::max(high_.x, frame.positions[i].x + radius), std::max(high_.y, frame.positions[i].y + radius)};
    }
  low_ = {std::max(low_.x, -furthest_shown) - room, std::max(low_.y, -furthest_shown) - room};
  high_ = {std::min(high_.x, furthest_shown) + room, std::min(high_.y, furthest_shown) + room};
  scale_ = std::min(most_width / (high_.x - low_.x), most_height / (high_.y - low_.y));
}

ArenaView ArenaView::moved_to(Point corner) const {
  ArenaView view = *this;
  view.corner_ = corner;
  return view;
}

Point ArenaView::clamped(const Point& position, double radius) const {
  // A landmark may be larger than the view; the middle is then as good as any place.
  const auto clamp = [radius](double x, double low, double high) {
    return std::max(std::min(x, high - radius), std::min(low + radius, (low + high) / 2));
  };
  return {clamp(position.x, low_.x, high_.x), clamp(position.y, low_.y, high_.y)};
}

Point ArenaView::place(const Point& position, double radius) const {
  const Point shown = clamped(position, radius);
  return {corner_.x + scale_ * (shown.x - low_.x), corner_.y + scale_ * (high_.y - shown.y)};
}

bool ArenaView::beyond(const Point& position, double radius) const { return clamped(position, radius) != position; }

std::vector<Shape> draw_landmark(Role role, const Point& centre, double radius) {
  if (role == Role::forest) return {Circle{centre, radius, Paint{forest_colour, 0.22}, Paint{forest_colour, 0.8}, 1}};
  if (role == Role::food) return {Circle{centre, radius, Paint{food_colour}, Paint{"#7d3f61"}, 1}};
  return {Circle{centre, radius, Paint{obstacle_colour, 0.75}, Paint{"#5f5f5f"}, 1}};
}

std::vector<Shape> draw_touch(const Point& centre) {
  return {Circle{centre, 2.6, Paint{touch_colour}, Paint{dark}, 0.8}};
}

std::vector<Shape> draw_ground(const Film& film, const ArenaView& view) {
  Path panel = rectangle(view.corner(), view.width(), view.height());
  panel.fill = Paint{"#f1f1f1"};
  panel.line = Paint{"#cccccc"};
  const Point top_left = view.place({-1, 1}, 0);
  Path arena = rectangle(top_left, 2 * view.scale(), 2 * view.scale());
  arena.fill = Paint{"#ffffff"};
  arena.line = arena_line();
  std::vector<Shape> shapes{panel, arena};
  const auto& entities = film.scenario.entities;
  // Forests are large and hide nothing: whatever lies in one is drawn over it.
  for (const Role role : {Role::forest, Role::obstacle, Role::food})
    for (std::size_t i = film.scenario.agents(); i < entities.size(); ++i) {
      if (entities[i].role != role) continue;
      const Point centre = view.place(film.frames[0].positions[i], entities[i].radius);
      for (const auto& shape : draw_landmark(role, centre, view.scale() * entities[i].radius)) shapes.push_back(shape);
    }
  return shapes;
}

std::vector<Point> trail(const Film& film, const ArenaView& view, std::size_t agent, std::size_t last) {
  const double radius = film.scenario.entities[agent].radius;
  std::vector<Point> places;
  for (std::size_t i = 0; i <= last; ++i) places.push_back(view.place(film.frames[i].positions[agent], radius));
  return places;
}

std::vector<Shape> draw_trails(const Film& film, const ArenaView& view, std::size_t last) {
  std::vector<Shape> shapes;
  const auto& scenario = film.scenario;
  for (std::size_t agent = 0; agent < scenario.agents(); ++agent) {
    const Paint faint{colour_of(scenario, agent), 0.55};
    const auto places = trail(film, view, agent, last);
    shapes.emplace_back(Circle{places.front(), view.scale() * scenario.entities[agent].radius, {}, faint, 1});
    for (const auto& piece : pieces_in_view(film, view, agent, last))
      shapes.emplace_back(Path{piece, false, {}, faint, 1.5});
  }
  return shapes;
}

std::vector<Shape> draw_touches(const Film& film, const ArenaView& view, std::size_t last) {
  std::vector<Shape> shapes;
  const std::size_t prey = film.scenario.prey();
  const auto places = trail(film, view, prey, last);
  for (std::size_t i = 0; i <= last; ++i)
    if (film.frames[i].touching[prey] && !is_beyond(film, view, prey, i))
      for (const auto& shape : draw_touch(places[i])) shapes.push_back(shape);
  return shapes;
}

std::vector<Shape> draw_agent(const Film& film, const ArenaView& view, std::size_t agent, const Point& centre,
                              bool beyond) {
  const double radius = view.scale() * film.scenario.entities[agent].radius;
  const auto colour = colour_of(film.scenario, agent);
  std::vector<Shape> shapes{Circle{centre, radius, Paint{colour, beyond ? beyond_opacity : 1}, Paint{"#ffffff"}, 0.8}};
  if (agent != film.scenario.prey() && radius >= least_numbered_radius)
    shapes.emplace_back(
        Text{centre, fmt::format("{}", agent), std::min(1.25 * radius, 13.0), Text::Anchor::middle, true, "#ffffff"});
  return shapes;
}

std::vector<Shape> draw_contact(const Film& film, const ArenaView& view, std::size_t agent, const Point& centre) {
  const double radius = view.scale() * film.scenario.entities[agent].radius;
  const double width = std::clamp(0.2 * radius, 1.4, 3.0);
  const double middle = radius + width / 2;
  return {Circle{centre, middle, {}, Paint{dark}, width + 1.4}, Circle{centre, middle, {}, Paint{touch_colour}, width}};
}

std::vector<Shape> draw_frame(const Film& film, const ArenaView& view, std::size_t frame) {
  std::vector<Shape> shapes = draw_ground(film, view);
  const auto add = [&](const std::vector<Shape>& more) { shapes.insert(shapes.end(), more.begin(), more.end()); };
  add(draw_trails(film, view, frame));
  add(draw_touches(film, view, frame));
  const auto& [step, positions, touching, predators_return] = film.frames[frame];
  for (std::size_t agent = 0; agent < film.scenario.agents(); ++agent) {
    const double radius = film.scenario.entities[agent].radius;
    const Point centre = view.place(positions[agent], radius);
    add(draw_agent(film, view, agent, centre, view.beyond(positions[agent], radius)));
    if (touching[agent]) add(draw_contact(film, view, agent, centre));
  }
  return shapes;
}

}  // namespace folk::mpe
