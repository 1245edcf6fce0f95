#include <folk/analysis/pictures/gnuplot_script.h>
#include <folk/mpe/pictures/learning_curve.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace folk::mpe {
namespace {

using namespace gnuplot;

/// Okabe & Ito's colours, which the colour-blind can tell apart.
constexpr std::array line_colours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"};
constexpr double curve_row_height = 18.5;

void require_sound(const LearningCurvePlot& plot) {
  if (plot.curves.empty()) throw UsageError("a learning curve's picture needs at least one run");
  for (const auto& curve : plot.curves) {
    if (curve.episodes.empty() || curve.episodes.size() != curve.returns.size())
      throw UsageError(fmt::format("the run '{}' has no evaluations, or not one return for each", excerpt(curve.name)));
    for (const auto* numbers : {&curve.episodes, &curve.returns})
      for (const double number : *numbers)
        if (!std::isfinite(number))
          throw UsageError(fmt::format("the run '{}' has a number that is not finite", excerpt(curve.name)));
  }
}

/// The names of the curves, then those of the marks with their values; long ones, of files, without their middle.
std::vector<std::string> legend_names(const LearningCurvePlot& plot) {
  constexpr double widest = 560;
  std::vector<std::string> names;
  for (const auto& curve : plot.curves) names.push_back(fitted(curve.name, text_font, widest));
  for (const auto& mark : plot.marks)
    names.push_back(fmt::format("{} ({:.1f})", fitted(mark.name, text_font, widest - 100), mark.value));
  return names;
}

gnuplot::Layout layout_of(const LearningCurvePlot& plot) {
  gnuplot::Layout layout;
  layout.left = 70;
  layout.right = layout.left + 560;
  layout.top = 44;
  layout.bottom = layout.top + 320;
  layout.width = layout.right + 24;
  for (const auto& name : legend_names(plot)) layout.width = std::max(layout.width, 130 + text_width(name, text_font));
  layout.height =
      layout.bottom + 56 + curve_row_height * static_cast<double>(plot.curves.size() + plot.marks.size()) + 12;
  return with_words(layout, plot.title, plot.caption);
}

std::string axes(const LearningCurvePlot& plot, const gnuplot::Layout& layout, PictureFormat format) {
  double last = 1;
  for (const auto& curve : plot.curves) last = std::max(last, curve.episodes.back());
  std::string text = fmt::format("set xrange [0:{}]\n", last);
  text += "set border 3 lw 0.5 lc rgb '#666666'\nset grid lt 1 lw 0.5 lc rgb '#e4e4e4'\n";
  for (const char* axis : {"x", "y"})
    text +=
        fmt::format("set {}tics nomirror format '%g' scale 0.3 font ',{}' textcolor rgb 'black'\n", axis, text_font);
  text += fmt::format("set label 'episodes played' at {},{} center font ',{}'\n",
                      layout.x((layout.left + layout.right) / 2), layout.y(layout.bottom + 40), text_font);
  text += fmt::format("set label {} at {},{} rotate by 90 center font ',{}'\n", text_literal(plot.unit), layout.x(20),
                      layout.y((layout.top + layout.bottom) / 2), text_font);
  return text + fmt::format("set key at {},{} left top Left reverse samplen 2 spacing {} font ',{}'\n",
                            layout.x(layout.left - 20), layout.y(layout.bottom + 56),
                            format == PictureFormat::svg ? 1.0 : 1.25, text_font);
}

}  // namespace

std::string learning_curve_script(const LearningCurvePlot& plot, PictureFormat format) {
  require_sound(plot);
  const auto layout = layout_of(plot);
  const auto names = legend_names(plot);
  std::string data;
  std::vector<std::string> layers;
  for (std::size_t i = 0; i < plot.curves.size(); ++i) {
    data += fmt::format("$RUN{0} << END_OF_{0}\n", i);
    for (std::size_t k = 0; k < plot.curves[i].episodes.size(); ++k)
      data += fmt::format("{} {}\n", plot.curves[i].episodes[k], plot.curves[i].returns[k]);
    data += fmt::format("END_OF_{}\n", i);
    layers.push_back(fmt::format("$RUN{} using 1:2 with lines lw 1.6 lc rgb '{}' title {}", i,
                                 line_colours[i % line_colours.size()], text_literal(names[i])));
  }
  for (std::size_t i = 0; i < plot.marks.size(); ++i)
    layers.push_back(fmt::format("{} with lines lw 1 dt 2 lc rgb '#666666' title {}", plot.marks[i].value,
                                 text_literal(names[plot.curves.size() + i])));
  return opening(format, layout, plot.title, plot.caption) + axes(plot, layout, format) + data +
         fmt::format("plot {}\n", fmt::join(layers, ", \\\n     "));
}

void draw(const LearningCurvePlot& plot, const std::filesystem::path& path) {
  const std::string name = plot.title.empty() ? plot.unit + " over the episodes played" : plot.title;
  draw_script(path, name, [&](PictureFormat format) { return learning_curve_script(plot, format); });
}

}  // namespace folk::mpe
