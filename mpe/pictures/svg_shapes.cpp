#include <folk/analysis/pictures/gnuplot_script.h>
#include <folk/mpe/pictures/svg_shapes.h>

#include <fmt/format.h>

#include <cmath>

namespace folk::mpe {
namespace {

std::string opacity(std::string_view attribute, double value) {
  return value < 1 ? fmt::format(" {}=\"{:.2g}\"", attribute, value) : std::string();
}

std::string paints(const std::optional<Paint>& fill, const std::optional<Paint>& line, double width) {
  std::string text = fmt::format(" fill=\"{}\"", fill ? fill->colour : "none");
  if (fill) text += opacity("fill-opacity", fill->opacity);
  if (line)
    text += fmt::format(" stroke=\"{}\" stroke-width=\"{}\"", line->colour, svg_number(width)) +
            opacity("stroke-opacity", line->opacity);
  return text;
}

struct SvgWriter {
  std::string operator()(const Circle& circle) const {
    return fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\"{}/>\n", svg_number(circle.centre.x),
                       svg_number(circle.centre.y), svg_number(circle.radius),
                       paints(circle.fill, circle.line, circle.width));
  }

  std::string operator()(const Path& path) const {
    return fmt::format("<path d=\"{}{}\"{} stroke-linejoin=\"round\"/>\n", svg_path_data(path.corners),
                       path.closed ? "z" : "", paints(path.fill, path.line, path.width));
  }

  std::string operator()(const Text& text) const {
    constexpr double half_capital = 0.36;  // of the letters' size
    return fmt::format("<text x=\"{}\" y=\"{}\" font-size=\"{}\" fill=\"{}\"{}{}>{}</text>\n", svg_number(text.at.x),
                       svg_number(text.at.y + half_capital * text.size), svg_number(text.size), text.colour,
                       text.anchor == Text::Anchor::middle ? " text-anchor=\"middle\"" : "",
                       text.bold ? " font-weight=\"bold\"" : "", xml_text(text.text));
  }
};

}  // namespace

std::string svg_number(double value) { return fmt::format("{}", std::round(10 * value) / 10 + 0.0); }

std::string svg_path_data(const std::vector<Point>& corners) {
  std::string text;
  for (const auto& corner : corners)
    text += fmt::format("{}{} {}", text.empty() ? "M" : " ", svg_number(corner.x), svg_number(corner.y));
  return text;
}

std::string xml_text(std::string_view text) { return gnuplot::xml_text(text); }

std::string svg_elements(const std::vector<Shape>& shapes) {
  std::string text;
  for (const auto& shape : shapes) text += std::visit(SvgWriter{}, shape);
  return text;
}

std::string svg_document(double width, double height, std::string_view title, std::string_view body) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" role=\"img\" "
      "font-family=\"Arial,Helvetica,DejaVu Sans,sans-serif\">\n<title>{2}</title>\n{3}</svg>\n",
      svg_number(width), svg_number(height), xml_text(title), body);
}

}  // namespace folk::mpe
