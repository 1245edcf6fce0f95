#pragma once
// A picture as a list of shapes, drawn one over the other in their order: put together once, written as SVG
// (svg_shapes.h) or as a gnuplot script (gnuplot_shapes.h).

#include <folk/mpe/world/batch.h>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace folk::mpe {

/// A colour, "#rrggbb", and how much of it covers what lies below: 1 all.
struct Paint {
  std::string_view colour;
  double opacity = 1;
};

/// Places and lengths are in pixels, from the picture's top left corner to the right and down.
struct Circle {
  Point centre;
  double radius = 0;
  std::optional<Paint> fill;
  std::optional<Paint> line;
  double width = 1;  ///< of the line
};

/// Straight lines from corner to corner.
struct Path {
  std::vector<Point> corners;
  bool closed = false;
  std::optional<Paint> fill;  ///< of a closed one
  std::optional<Paint> line;
  double width = 1;
};

struct Text {
  enum class Anchor { left, middle };

  Point at;  ///< its left end or its middle, at half the height of a capital
  std::string text;
  double size = 12;
  Anchor anchor = Anchor::left;
  bool bold = false;
  std::string_view colour = "#222222";
};

using Shape = std::variant<Circle, Path, Text>;

struct Picture {
  double width = 0;
  double height = 0;
  std::vector<Shape> shapes;
  std::string title{};  ///< what a screen reader says

  void add(std::vector<Shape> more) { shapes.insert(shapes.end(), more.begin(), more.end()); }
};

/// A closed path around a rectangle.
Path rectangle(Point top_left, double width, double height);

/// Any text as a picture can show it, at most `most` characters, the middle of a longer one left out: control
/// characters become blanks, bytes that are no UTF-8 question marks.
std::string printable(std::string_view text, std::size_t most);

}  // namespace folk::mpe
