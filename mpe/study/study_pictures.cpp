#include <folk/analysis/pictures/gnuplot_script.h>
#include <folk/mpe/study/study_blocks.h>
#include <folk/mpe/study/study_pictures.h>
#include <folk/mpe/study/study_words.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace folk::mpe {
namespace {

using namespace gnuplot;

/// Okabe & Ito's colours, which the colour-blind can tell apart, each with a sign of its own.
constexpr std::array colours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#444444"};
constexpr std::array signs = {7, 5, 9, 11, 13, 6, 4};
constexpr double legend_row = 18.5;
constexpr double axis_room = 56;

const char* colour(std::size_t i) { return colours[i % colours.size()]; }
int sign(std::size_t i) { return signs[i % signs.size()]; }

/// The look of a learner, the same in all pictures; no two of one picture share one.
std::size_t look_of(std::string_view learner) {
  using Look = std::pair<std::string_view, std::size_t>;
  static constexpr std::array looks{Look{"sct", 0},          Look{"madt", 1},         Look{"rmadt", 2},
                                    Look{"omar", 3},         Look{"lead_pursuit", 3}, Look{"bc", 4},
                                    Look{"sct-selfconf", 5}, Look{"ma-bcq", 6},       Look{"matd3", 6}};
  for (const auto& [name, look] : looks)
    if (name == learner) return look;
  return 0;
}

void require_finite(std::initializer_list<double> numbers, const std::string& title) {
  for (const double number : numbers)
    if (!std::isfinite(number))
      throw UsageError(fmt::format("the picture '{}' has a number that is not finite", excerpt(title)));
}

void require_any(bool any, const std::string& title) {
  if (!any) throw UsageError(fmt::format("the picture '{}' has nothing to draw", excerpt(title)));
}

/// A span of an axis that grows by what it must show.
struct Span {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void show(double value, double half = 0) {
    low = std::min(low, value - half);
    high = std::max(high, value + half);
  }
  /// With room at both ends, never empty.
  Span padded() const {
    const double room = high > low ? 0.06 * (high - low) : 1;
    return {low - room, high + room};
  }
};

gnuplot::Layout layout_of(const std::string& title, const Caption& caption, double width, double height,
                          std::size_t legend_rows) {
  gnuplot::Layout layout;
  layout.left = 70;
  layout.right = layout.left + width;
  layout.top = 44;
  layout.bottom = layout.top + height;
  layout.width = layout.right + 24;
  layout.height = layout.bottom + axis_room + legend_row * static_cast<double>(legend_rows) + 12;
  return with_words(layout, title, caption);
}

/// Frame, grid, titles of the axes and the legend below them.
std::string axes(const gnuplot::Layout& layout, PictureFormat format, const std::string& x_title,
                 const std::string& y_title) {
  std::string text = "set border 3 lw 0.5 lc rgb '#666666'\nset grid lt 1 lw 0.5 lc rgb '#e4e4e4'\n";
  for (const char* axis : {"x", "y"})
    text +=
        fmt::format("set {}tics nomirror format '%g' scale 0.3 font ',{}' textcolor rgb 'black'\n", axis, text_font);
  text += fmt::format("set label {} at {},{} center font ',{}'\n", text_literal(x_title),
                      layout.x((layout.left + layout.right) / 2), layout.y(layout.bottom + 40), text_font);
  text += fmt::format("set label {} at {},{} rotate by 90 center font ',{}'\n", text_literal(y_title), layout.x(20),
                      layout.y((layout.top + layout.bottom) / 2), text_font);
  return text + fmt::format("set key at {},{} left top Left reverse samplen 2 spacing {} font ',{}'\n",
                            layout.x(layout.left - 20), layout.y(layout.bottom + axis_room),
                            format == PictureFormat::svg ? 1.0 : 1.25, text_font);
}

std::string block(const std::string& name, const std::string& rows) {
  return fmt::format("${0} << END_OF_{0}\n{1}END_OF_{0}\n", name, rows);
}

std::string plotted(const std::vector<std::string>& layers) {
  return fmt::format("plot {}\n", fmt::join(layers, ", \\\n     "));
}

/// The data of one kind's bars: middle, share, the ends of its interval, width; and of its marks: left end, share,
/// width.
struct BarRows {
  std::string bars, marks;
};
BarRows bars_of(const ShareBarsPlot& plot, std::size_t k) {
  constexpr double group_share = 0.8;  // of a group's width that its bars take
  const double width = group_share / static_cast<double>(plot.kinds.size());
  const auto& bars = plot.kinds[k].bars;
  if (bars.size() != plot.groups.size())
    throw UsageError(fmt::format("the picture '{}' has not one bar a group", excerpt(plot.title)));
  BarRows rows;
  for (std::size_t g = 0; g < bars.size(); ++g) {
    const double middle = static_cast<double>(g) - group_share / 2 + (static_cast<double>(k) + 0.5) * width;
    if (const auto& cell = bars[g].cell) {
      require_finite({cell->mean, cell->ci95}, plot.title);
      rows.bars += fmt::format("{:.6f} {} {} {} {:.6f}\n", middle, cell->mean, std::max(0.0, cell->mean - cell->ci95),
                               std::min(1.0, cell->mean + cell->ci95), 0.9 * width);
    }
    if (const auto& mark = bars[g].mark) {
      require_finite({*mark}, plot.title);
      rows.marks += fmt::format("{:.6f} {} {:.6f}\n", middle - width / 2, *mark, width);
    }
  }
  return rows;
}

/// The block of a scenario and the level expert, if there is one.
template <class Row>
const StudyBlock<Row>* expert_block(const std::vector<StudyBlock<Row>>& blocks, const std::string& scenario) {
  for (const auto& one : blocks)
    if (one.scenario == scenario && one.level == "expert") return &one;
  return nullptr;
}

constexpr const char* score_title = "normalised score";

std::string data_words(const StudyTables& tables) {
  return tables.data_prey == "released" ? "expert data" : fmt::format("expert data against {}", tables.data_prey);
}

/// The scenario is the game; its episodes are all of one length.
Caption caption_of(const StudyTables& tables, const std::string& scenario) {
  return {scenario, tables.budget.empty() ? "" : "budget " + tables.budget};
}

std::optional<IntervalCurvesPlot> blend_plot(const StudyTables& tables, const std::string& scenario) {
  const auto blocks = blend_blocks(tables);
  const auto* found = expert_block(blocks, scenario);
  if (found == nullptr) return std::nullopt;
  IntervalCurvesPlot plot{fmt::format("{}: score against blends of the prey, {}", scenario, data_words(tables)),
                          "p: how likely the prey plays as released in a step, else at random",
                          score_title,
                          {},
                          caption_of(tables, scenario)};
  for (const char* learner : {"sct", "madt", "matd3", "lead_pursuit"})
    for (const auto& line : found->lines) {
      if (line.learner != learner) continue;
      IntervalCurve curve{learner_title(learner), look_of(learner), {}};
      for (const auto* row : line.cells)
        if (row != nullptr && row->score) curve.points.push_back({row->p, row->score->mean, row->score->ci95});
      if (!curve.points.empty()) plot.curves.push_back(std::move(curve));
    }
  if (plot.curves.empty()) return std::nullopt;
  return plot;
}

std::optional<IntervalCurvesPlot> asked_plot(const StudyTables& tables, const std::string& scenario) {
  IntervalCurvesPlot plot{fmt::format("{}: what SCT earns when asked for a return, {}", scenario, data_words(tables)),
                          "return that is asked for",
                          score_title,
                          {},
                          caption_of(tables, scenario)};
  for (const auto& prey : table_preys()) {
    IntervalCurve curve{"against " + prey_title(prey), plot.curves.size(), {}};
    for (const auto& row : tables.asked)
      if (row.scenario == scenario && row.level == "expert" && row.learner == "sct" && row.prey == prey && row.score)
        curve.points.push_back({row.target, row.score->mean, row.score->ci95});
    if (!curve.points.empty()) plot.curves.push_back(std::move(curve));
  }
  if (plot.curves.empty()) return std::nullopt;
  return plot;
}

std::optional<AgreementPlot> agreement_plot(const StudyTables& tables, const std::string& scenario) {
  AgreementPlot plot{fmt::format("{}: scores held against the paper's", scenario), {}, caption_of(tables, scenario)};
  for (const auto& row : tables.scores) {
    if (row.scenario != scenario || !to_paper(row)) continue;
    const std::string name = learner_title(row.learner);
    auto found =
        std::find_if(plot.learners.begin(), plot.learners.end(), [&](const auto& l) { return l.name == name; });
    if (found == plot.learners.end())
      found = plot.learners.insert(plot.learners.end(), {name, look_of(row.learner), {}});
    found->points.push_back({*row.paper, paper_ci95(row.paper_sd.value_or(0)), row.score->mean, row.score->ci95});
  }
  if (plot.learners.empty()) return std::nullopt;
  return plot;
}

std::optional<ShareBarsPlot> accuracy_plot(const StudyTables& tables, const std::string& scenario) {
  const auto blocks = accuracy_blocks(tables);
  const auto* found = expert_block(blocks, scenario);
  if (found == nullptr || !found->begun()) return std::nullopt;
  ShareBarsPlot plot{fmt::format("{}: beliefs within 0.6, {}", scenario, data_words(tables)),
                     "share of steps",
                     tables.data_prey == "released" ? "the paper's" : "",
                     {},
                     {},
                     caption_of(tables, scenario)};
  for (const auto& prey : found->columns) plot.groups.push_back(prey_title(prey));
  for (const auto& line : found->lines) {
    ShareBarsPlot::Kind kind{learner_title(line.learner), look_of(line.learner), {}};
    for (const auto* row : line.cells)
      kind.bars.push_back(row == nullptr ? ShareBarsPlot::Bar{}
                                         : ShareBarsPlot::Bar{within_inferred(*row), row->paper});
    plot.kinds.push_back(std::move(kind));
  }
  return plot;
}

/// A picture of what there may be to draw.
template <class Plot, class Script>
void add(std::vector<StudyPicture>& pictures, const std::string& name, const std::optional<Plot>& plot,
         Script script_of) {
  if (!plot) return;
  pictures.push_back(
      {name, plot->title, [plot = *plot, script_of](PictureFormat format) { return script_of(plot, format); }});
}

}  // namespace

std::string interval_curves_script(const IntervalCurvesPlot& plot, PictureFormat format) {
  require_any(!plot.curves.empty(), plot.title);
  const auto layout = layout_of(plot.title, plot.caption, 560, 320, plot.curves.size());
  Span x, y;
  std::string data;
  std::vector<std::string> layers;
  for (std::size_t i = 0; i < plot.curves.size(); ++i) {
    require_any(!plot.curves[i].points.empty(), plot.title);
    auto points = plot.curves[i].points;
    for (const auto& point : points) {
      require_finite({point.x, point.y, point.ci95}, plot.title);
      x.show(point.x);
      y.show(point.y, point.ci95);
    }
    std::sort(points.begin(), points.end(), [](const CurvePoint& a, const CurvePoint& b) { return a.x < b.x; });
    std::string rows;
    for (const auto& point : points) rows += fmt::format("{} {} {}\n", point.x, point.y, point.ci95);
    data += block(fmt::format("CURVE{}", i), rows);
    layers.push_back(fmt::format("$CURVE{} using 1:2:3 with yerrorlines lw 1.6 pt {} ps 0.7 lc rgb '{}' title {}", i,
                                 sign(plot.curves[i].look), colour(plot.curves[i].look),
                                 text_literal(plot.curves[i].name)));
  }
  x = x.padded();
  y = y.padded();
  return opening(format, layout, plot.title, plot.caption) + axes(layout, format, plot.x_title, plot.y_title) +
         fmt::format("set xrange [{}:{}]\nset yrange [{}:{}]\n", x.low, x.high, y.low, y.high) + data + plotted(layers);
}

std::string agreement_script(const AgreementPlot& plot, PictureFormat format) {
  require_any(!plot.learners.empty(), plot.title);
  const auto layout = layout_of(plot.title, plot.caption, 420, 420, plot.learners.size() + 1);
  Span both;
  std::string data;
  std::vector<std::string> layers{"x with lines lw 1 dt 2 lc rgb '#666666' title 'equal'"};
  for (std::size_t i = 0; i < plot.learners.size(); ++i) {
    require_any(!plot.learners[i].points.empty(), plot.title);
    std::string rows;
    for (const auto& point : plot.learners[i].points) {
      require_finite({point.paper, point.paper_ci95, point.ours, point.ci95}, plot.title);
      both.show(point.paper);
      both.show(point.ours);
      rows += fmt::format("{} {} {} {}\n", point.paper, point.ours, point.paper_ci95, point.ci95);
    }
    data += block(fmt::format("LEARNER{}", i), rows);
    layers.push_back(fmt::format("$LEARNER{} using 1:2:3:4 with xyerrorbars lw 1 pt {} ps 0.8 lc rgb '{}' title {}", i,
                                 sign(plot.learners[i].look), colour(plot.learners[i].look),
                                 text_literal(plot.learners[i].name)));
  }
  both = both.padded();
  return opening(format, layout, plot.title, plot.caption) + axes(layout, format, "score in the paper", "score here") +
         fmt::format("set xrange [{0}:{1}]\nset yrange [{0}:{1}]\n", both.low, both.high) + data + plotted(layers);
}

std::string share_bars_script(const ShareBarsPlot& plot, PictureFormat format) {
  const auto layout =
      layout_of(plot.title, plot.caption, 560, 300, plot.kinds.size() + (plot.mark_title.empty() ? 0 : 1));
  std::string data, marks;
  std::vector<std::string> layers;
  for (std::size_t k = 0; k < plot.kinds.size(); ++k) {
    const auto rows = bars_of(plot, k);
    marks += rows.marks;
    if (rows.bars.empty()) continue;
    data += block(fmt::format("KIND{}", k), rows.bars);
    layers.push_back(fmt::format("$KIND{} using 1:2:5 with boxes fs solid 0.75 noborder lc rgb '{}' title {}", k,
                                 colour(plot.kinds[k].look), text_literal(plot.kinds[k].name)));
    layers.push_back(
        fmt::format("$KIND{} using 1:3:(0):($4-$3) with vectors nohead lw 1.2 lc rgb '#333333' notitle", k));
  }
  require_any(!layers.empty(), plot.title);
  if (!marks.empty()) {
    data += block("MARKS", marks);
    layers.push_back(fmt::format("$MARKS using 1:2:3:(0) with vectors nohead lw 2 lc rgb 'black' title {}",
                                 text_literal(plot.mark_title)));
  }
  return opening(format, layout, plot.title, plot.caption) + axes(layout, format, "against the prey", plot.y_title) +
         "unset grid\nset grid ytics lt 1 lw 0.5 lc rgb '#e4e4e4'\n" +
         name_tics("xtics", plot.groups, text_font, "nomirror") +
         fmt::format("set xrange [-0.6:{}]\nset yrange [0:1.05]\n", static_cast<double>(plot.groups.size()) - 0.4) +
         data + plotted(layers);
}

std::vector<StudyPicture> study_pictures(const StudyTables& tables) {
  const std::string prefix = file_prefix(tables);
  std::vector<StudyPicture> pictures;
  for (const auto& scenario : study_scenarios()) {
    add(pictures, prefix + "scores_" + scenario, agreement_plot(tables, scenario), agreement_script);
    add(pictures, prefix + "blend_" + scenario, blend_plot(tables, scenario), interval_curves_script);
    add(pictures, prefix + "accuracy_" + scenario, accuracy_plot(tables, scenario), share_bars_script);
    add(pictures, prefix + "asked_" + scenario, asked_plot(tables, scenario), interval_curves_script);
  }
  return pictures;
}

std::vector<std::string> study_picture_names(const StudyTables& tables) {
  std::vector<std::string> names;
  for (const auto& scenario : study_scenarios())
    for (const char* kind : {"scores_", "blend_", "accuracy_", "asked_"})
      names.push_back(file_prefix(tables) + kind + scenario);
  return names;
}

void draw(const StudyPicture& picture, const std::filesystem::path& path) {
  draw_script(path, picture.words, picture.script);
}

}  // namespace folk::mpe
