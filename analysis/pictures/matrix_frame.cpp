#include <folk/analysis/pictures/matrix_frame.h>

#include <fmt/format.h>

#include <algorithm>

namespace folk::gnuplot {
namespace {

double matrix_name_font(std::size_t strategies) {
  const double cell = cell_size(strategies);
  return cell >= 40 ? 12 : cell >= 18 ? 11 : cell - 1.5;
}

}  // namespace

double cell_size(std::size_t strategies) {
  if (strategies <= 8) return 54;
  if (strategies <= 24) return 40;  // room for a number
  if (strategies <= most_lined) return 18;
  return strategies <= 120 ? 12 : 9;
}

Layout matrix_layout(const std::vector<std::string>& names) {
  const double side = static_cast<double>(names.size()) * cell_size(names.size());
  const double widest = widest_name(names, matrix_name_font(names.size()));
  Layout layout;
  layout.left = 14 + 22 + widest + 8;
  layout.top = 36 + 20 + widest + 8;
  layout.right = layout.left + side;
  layout.bottom = layout.top + side;
  layout.width = layout.right + 14;
  layout.height = layout.bottom + 16;
  return layout;
}

std::string matrix_axes(const Layout& layout, const std::vector<std::string>& names, std::string_view rows,
                        std::string_view columns) {
  const double font = matrix_name_font(names.size());
  const double far = static_cast<double>(names.size()) - 0.5;
  std::string text = fmt::format("set xrange [-0.5:{0}]\nset x2range [-0.5:{0}]\nset yrange [{0}:-0.5]\n", far);
  text += "unset xtics\nset border lw 0.5 lc rgb '#666666'\n";
  text += name_tics("x2tics", names, font, "rotate by 90 left offset 0,0.1");
  text += name_tics("ytics", names, font, "");
  const std::string note = fmt::format("font ',{}' textcolor rgb '#444444'\n", note_font);
  text += fmt::format("set label {} at {},{} center {}", text_literal(columns),
                      layout.x((layout.left + layout.right) / 2), layout.y(48), note);
  return text + fmt::format("set label {} at {},{} rotate by 90 center {}", text_literal(rows), layout.x(20),
                            layout.y((layout.top + layout.bottom) / 2), note);
}

}  // namespace folk::gnuplot
