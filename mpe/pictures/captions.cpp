#include <folk/analysis/pictures/gnuplot_script.h>
#include <folk/mpe/pictures/captions.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace folk::mpe {
namespace {

using gnuplot::note_font;
using gnuplot::text_font;
using gnuplot::title_font;

constexpr double legend_row_height = 22;
constexpr double sign_radius = 7;
constexpr double sign_middle = 13;  // from the left edge of a column
constexpr double label_left = 31;

struct Entry {
  std::string label;
  std::function<std::vector<Shape>(const Point& centre)> sign;
};

std::vector<Shape> discs(const Scenario& scenario, std::size_t first, std::size_t end, const Point& centre) {
  std::vector<Shape> shapes;
  const double spread = end - first > 1 ? sign_radius : 0;
  for (std::size_t i = first; i < end; ++i) {
    const double share = end - first > 1 ? static_cast<double>(i - first) / static_cast<double>(end - first - 1) : 0.5;
    shapes.emplace_back(Circle{{centre.x + spread * (2 * share - 1), centre.y},
                               sign_radius - 1.5,
                               Paint{colour_of(scenario, i)},
                               Paint{"#ffffff"},
                               0.8});
  }
  return shapes;
}

std::vector<Shape> arena_sign(const Point& centre) {
  Path box = rectangle({centre.x - sign_radius, centre.y - sign_radius}, 2 * sign_radius, 2 * sign_radius);
  box.line = arena_line();
  return {box};
}

bool touched(const Film& film) {
  return std::any_of(film.frames.begin(), film.frames.end(),
                     [&](const Frame& frame) { return frame.touching[film.scenario.prey()]; });
}

bool leaves_view(const Film& film, const ArenaView& view) {
  for (const auto& frame : film.frames)
    for (std::size_t i = 0; i < frame.positions.size(); ++i)
      if (view.beyond(frame.positions[i], film.scenario.entities[i].radius)) return true;
  return false;
}

std::vector<Entry> entries(const Film& film, const ArenaView& view) {
  const auto& scenario = film.scenario;
  const auto agents = [&scenario](std::size_t first, std::size_t end) {
    return [&scenario, first, end](const Point& centre) { return discs(scenario, first, end, centre); };
  };
  std::vector<Entry> list{{"predators", agents(0, scenario.prey())},
                          {"prey", agents(scenario.prey(), scenario.prey() + 1)}};
  const auto landmark = [](Role role, double radius) {
    return [=](const Point& centre) { return draw_landmark(role, centre, radius); };
  };
  if (scenario.count(Role::obstacle) > 0) list.push_back({"obstacle", landmark(Role::obstacle, sign_radius)});
  if (scenario.count(Role::food) > 0) list.push_back({"food", landmark(Role::food, 4)});
  if (scenario.count(Role::forest) > 0) list.push_back({"forest", landmark(Role::forest, sign_radius)});
  list.push_back({"where they began", [](const Point& centre) -> std::vector<Shape> {
                    return {Circle{centre, sign_radius - 1.5, {}, Paint{"#555555", 0.7}, 1}};
                  }});
  if (touched(film)) list.push_back({"prey touched", draw_touch});
  list.push_back({"arena [-1, 1]²", arena_sign});
  if (leaves_view(film, view))
    list.push_back(
        {"beyond the edge", [&scenario](const Point& centre) -> std::vector<Shape> {
           return {
               Circle{centre, sign_radius - 1.5, Paint{colour_of(scenario, scenario.prey()), beyond_opacity}, {}, 1}};
         }});
  return list;
}

struct Columns {
  double width = 0;
  std::size_t count = 1;
  std::size_t rows = 1;
};

Columns columns_of(const std::vector<Entry>& list, double width) {
  std::vector<std::string> labels;
  for (const auto& entry : list) labels.push_back(entry.label);
  Columns columns;
  columns.width = label_left + gnuplot::widest_name(labels, text_font) + 8;
  columns.count = std::clamp<std::size_t>(static_cast<std::size_t>(width / columns.width), 1, list.size());
  columns.rows = (list.size() + columns.count - 1) / columns.count;
  return columns;
}

}  // namespace

std::vector<Shape> draw_heading(const Film& film) {
  return {Text{{margin, 22}, film.title, title_font, Text::Anchor::left, true},
          Text{{margin, 44}, film.subtitle, text_font, Text::Anchor::left, false, "#555555"}};
}

double heading_width(const Film& film) {
  constexpr double bold = 1.1;
  return 2 * margin + bold * gnuplot::text_width(film.title, title_font);
}

std::vector<Shape> draw_caption(const Film& film, double bottom) {
  return {Text{{margin, bottom - 14}, film.caption, note_font, Text::Anchor::left, false, "#666666"}};
}

double caption_width(const Film& film) { return 2 * margin + gnuplot::text_width(film.caption, note_font); }

double legend_height(const Film& film, const ArenaView& view, double width) {
  return legend_row_height * static_cast<double>(columns_of(entries(film, view), width).rows);
}

std::vector<Shape> draw_legend(const Film& film, const ArenaView& view, const Point& top_left, double width) {
  const auto list = entries(film, view);
  const Columns columns = columns_of(list, width);
  std::vector<Shape> shapes;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const double left = top_left.x + columns.width * static_cast<double>(i % columns.count);
    const double middle = top_left.y + legend_row_height * (static_cast<double>(i / columns.count) + 0.5);
    for (const auto& shape : list[i].sign({left + sign_middle, middle})) shapes.push_back(shape);
    shapes.emplace_back(Text{{left + label_left, middle}, list[i].label, text_font});
  }
  return shapes;
}

}  // namespace folk::mpe
