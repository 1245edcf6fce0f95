#include <folk/analysis/pictures/gnuplot_script.h>
#include <folk/mpe/pictures/gnuplot_shapes.h>

#include <fmt/format.h>

#include <cmath>

namespace folk::mpe {
namespace {

/// gnuplot writes a colour with its transparency in front: 00 hides what is below.
std::string colour(const Paint& paint) {
  return fmt::format("'#{:02x}{}'", std::lround(255 * (1 - paint.opacity)), paint.colour.substr(1));
}

/// Collects what becomes data, labels and the parts of one plot command, which gnuplot draws in their order.
struct GnuplotWriter {
  std::string data;
  std::string labels;
  std::vector<std::string> parts;
  std::size_t blocks = 0;

  void operator()(const Circle& circle) {
    const auto block = add_data(fmt::format("{:.2f} {:.2f} {:.2f}\n", circle.centre.x, circle.centre.y, circle.radius));
    if (circle.fill)
      parts.push_back(fmt::format("{} with circles fc rgb {} fs solid noborder", block, colour(*circle.fill)));
    if (circle.line)
      parts.push_back(
          fmt::format("{} with circles lc rgb {} lw {} fs empty border", block, colour(*circle.line), circle.width));
  }

  void operator()(const Path& path) {
    std::string lines;
    for (const auto& corner : path.corners) lines += fmt::format("{:.2f} {:.2f}\n", corner.x, corner.y);
    if (path.closed && !path.corners.empty())
      lines += fmt::format("{:.2f} {:.2f}\n", path.corners.front().x, path.corners.front().y);
    const auto block = add_data(lines);
    if (path.fill)
      parts.push_back(
          fmt::format("{} with filledcurves closed fc rgb {} fs solid noborder", block, colour(*path.fill)));
    if (path.line) parts.push_back(fmt::format("{} with lines lc rgb {} lw {}", block, colour(*path.line), path.width));
  }

  void operator()(const Text& text) {
    labels += fmt::format("set label {} at first {:.2f},{:.2f} {} front font '{},{}' textcolor rgb '{}'\n",
                          gnuplot::text_literal(text.text), text.at.x, text.at.y,
                          text.anchor == Text::Anchor::middle ? "center" : "left", text.bold ? "Sans:Bold" : "",
                          text.size, text.colour);
  }

  /// A block of data, by its name.
  std::string add_data(const std::string& lines) {
    const std::string name = fmt::format("$S{}", blocks++);
    data += fmt::format("{} << END_OF_DATA\n{}END_OF_DATA\n", name, lines);
    return name;
  }
};

}  // namespace

std::string gnuplot_script(const Picture& picture, PictureFormat format) {
  GnuplotWriter writer;
  for (const auto& shape : picture.shapes) std::visit(writer, shape);
  const gnuplot::Layout layout{picture.width, picture.height, 0, picture.width, 0, picture.height};
  // The axes are the picture's pixels.
  return gnuplot::opening(format, layout) +
         fmt::format("unset border\nunset tics\nset xrange [0:{}]\nset yrange [{}:0]\n", picture.width,
                     picture.height) +
         writer.labels + writer.data + fmt::format("plot {}\n", fmt::join(writer.parts, ", \\\n     "));
}

}  // namespace folk::mpe
