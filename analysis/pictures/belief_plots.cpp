#include <folk/analysis/pictures/belief_plots.h>
#include <folk/analysis/pictures/gnuplot_script.h>
#include <folk/analysis/pictures/plots.h>
#include <folk/games/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

namespace folk {
namespace {

namespace fs = std::filesystem;
using namespace gnuplot;

// A dark blue and a vermilion that every common colour vision tells apart; shapes differ as well.
constexpr std::string_view belief_colour = "#08519c";
constexpr std::string_view wrong_colour = "#d7301f";
constexpr std::string_view truth_colour = "#e08214";

void check_probability(double value, std::string_view what) {
  if (!(value >= 0 && value <= 1)) throw UsageError(fmt::format("a picture's {} is no probability", what));
}

/// Borders, grid and tics of both axes; what stands at the tics is set apart.
std::string plain_axes() {
  return fmt::format(
      "set border 3 lw 0.5 lc rgb '#666666'\nset grid lt 1 lw 0.5 lc rgb '#e4e4e4'\n"
      "set xtics nomirror scale 0.3 font ',{0}' textcolor rgb 'black'\n"
      "set ytics nomirror scale 0.3 font ',{0}' textcolor rgb 'black'\n",
      text_font);
}

std::string axis_name(const Layout& layout, std::string_view name) {
  return fmt::format("set label {} at {},{} center font ',{}'\n", text_literal(name),
                     layout.x((layout.left + layout.right) / 2), layout.y(layout.bottom + 38), text_font);
}

std::string side_name(const Layout& layout, std::string_view name) {
  return fmt::format("set label {} at {},{} rotate by 90 center font ',{}'\n", text_literal(name), layout.x(18),
                     layout.y((layout.top + layout.bottom) / 2), text_font);
}

std::string block(std::string_view name, const std::string& lines) {
  return fmt::format("${0} << END_OF_{0}\n{1}END_OF_{0}\n", name, lines);
}

// ---- Belief against truth ------------------------------------------------------------------------------------------

Layout belief_path_layout(const BeliefPathPlot& plot) {
  Layout layout;
  layout.left = 76;
  layout.right = layout.left + 620;
  layout.top = 48;
  layout.bottom = layout.top + 150;
  layout.width = layout.right + 20;
  layout.height = layout.bottom + 70;
  return with_words(layout, plot.title, plot.caption);
}

/// The rounds of a match in lines of data.
struct BeliefLines {
  std::string beliefs;
  std::string truths;  ///< of opponents that mix; else the moves say it all
  std::string right;   ///< moves that were held likelier, or of which nothing was believed
  std::string wrong;
};

BeliefLines belief_lines(const BeliefMatch& match, std::size_t rounds) {
  BeliefLines lines;
  bool mixes = false;
  for (std::size_t t = 0; t < rounds; ++t) {
    const BeliefRound& round = match[t];
    check_probability(round.truth, "truth");
    const bool cooperates = round.theirs == Move::C;
    bool right = true;
    if (round.belief) {
      check_probability(*round.belief, "belief");
      right = (*round.belief >= 0.5) == cooperates;
      lines.beliefs += fmt::format("{} {}\n", t + 1, *round.belief);
    } else {
      lines.beliefs += "\n";  // the line is broken where nothing was believed
    }
    mixes = mixes || (round.truth > 0 && round.truth < 1);
    lines.truths += fmt::format("{} {}\n", t + 1, round.truth);
    (right ? lines.right : lines.wrong) += fmt::format("{} {}\n", t + 1, cooperates ? 1 : 0);
  }
  if (!mixes) lines.truths.clear();
  if (lines.beliefs.find(' ') == std::string::npos) lines.beliefs.clear();
  return lines;
}

std::string belief_path_axes(const Layout& layout, std::size_t rounds) {
  const auto last = static_cast<double>(rounds);
  std::string text = plain_axes();
  text += fmt::format("set xrange [{}:{}]\nset yrange [-0.1:1.1]\n", 1 - 0.012 * last - 0.2, last + 0.012 * last + 0.2);
  text += "set ytics ('0 (D)' 0, '0.5' 0.5, '1 (C)' 1)\n";
  if (rounds < 10) text += "set xtics 1\n";
  text += axis_name(layout, "round") + side_name(layout, "P(C)");
  return text +
         fmt::format("set key at {},{} left bottom Left reverse vertical maxrows 1 width -5 samplen 1.6 font ',{}'\n",
                     layout.x(layout.left - 16), layout.y(layout.bottom + 64), text_font);
}

std::string belief_path_layers(const BeliefLines& lines, std::size_t rounds) {
  const double dot = rounds <= 120 ? 0.4 : 0.25;
  std::string data;
  std::vector<std::string> layers;
  const auto add = [&](std::string_view name, const std::string& points, const std::string& style,
                       std::string_view title) {
    if (points.empty()) return;
    data += block(name, points);
    layers.push_back(fmt::format("${} using 1:2 with {} title '{}'", name, style, title));
  };
  add("TRUTHS", lines.truths, fmt::format("steps lw 1.5 dt 3 lc rgb '{}'", truth_colour), "truth");
  add("BELIEFS", lines.beliefs, fmt::format("linespoints lw 1.3 pt 7 ps {} lc rgb '{}'", dot / 2, belief_colour),
      "belief");
  add("RIGHT", lines.right, fmt::format("points pt 7 ps {} lc rgb '#444444'", dot), "move as believed");
  add("WRONG", lines.wrong, fmt::format("points pt 9 ps {} lc rgb '{}'", dot + 0.2, wrong_colour), "move not believed");
  return data + fmt::format("plot {}\n", fmt::join(layers, ", \\\n     "));
}

// ---- Accuracy ------------------------------------------------------------------------------------------------------

Layout accuracy_layout(const AccuracyPlot& plot) {
  const double row = row_height(plot.names.size());
  Layout layout;
  layout.left = 14 + widest_name(plot.names, std::min(text_font, row - 1.5)) + 8;
  layout.right = layout.left + 300;
  layout.top = 44;
  layout.bottom = layout.top + row * static_cast<double>(plot.names.size()) + 8;
  layout.width = layout.right + 62;
  layout.height = layout.bottom + 54;
  return with_words(layout, plot.title, plot.caption);
}

std::string accuracy_bars(const AccuracyPlot& plot) {
  std::string bars;
  for (std::size_t i = 0; i < plot.shares.size(); ++i) {
    if (!plot.shares[i]) continue;
    check_probability(*plot.shares[i], "accuracy");
    bars += fmt::format("{} {} \"{:.1f} %\"\n", i, 100 * *plot.shares[i], 100 * *plot.shares[i]);
  }
  if (bars.empty()) return "plot -9 notitle\n";
  const double font = std::min(note_font, row_height(plot.names.size()) - 1.5);
  return block("BARS", bars) +
         "half = 0.36\n"
         "plot $BARS using 2:1:(0):2:($1-half):($1+half) with boxxyerror fc rgb '#b8d4ea' lw 1 fs solid 1 border rgb "
         "'#2b5c8a', \\\n" +
         fmt::format("     $BARS using 2:1:3 with labels left offset character 0.4,0 font ',{}'\n", font);
}

// ---- Calibration ---------------------------------------------------------------------------------------------------

Layout calibration_layout(const CalibrationPlot& plot) {
  Layout layout;
  layout.left = 72;
  layout.right = layout.left + 340;
  layout.top = 44;
  layout.bottom = layout.top + 340;
  layout.width = layout.right + 40;
  layout.height = layout.bottom + 88;
  return with_words(layout, plot.title, plot.caption);
}

/// A count in at most 5 characters: "950", "12.3k", "1.2M".
std::string count_text(std::uint64_t count) {
  const auto value = static_cast<double>(count);
  if (count < 10'000) return std::to_string(count);
  return count < 1'000'000 ? fmt::format("{:.0f}k", value / 1e3) : fmt::format("{:.3g}M", value / 1e6);
}

std::string calibration_bins(const CalibrationPlot& plot) {
  std::uint64_t most = 1;
  for (const auto& bin : plot.bins) most = std::max(most, bin.count);
  std::string lines;
  for (const auto& bin : plot.bins) {
    if (bin.count == 0) continue;
    check_probability(*bin.mean_belief(), "belief");
    check_probability(*bin.frequency(), "frequency");
    // The area of a dot is its bin's share of the rounds, and no dot vanishes.
    const double size = 0.5 + 1.6 * std::sqrt(static_cast<double>(bin.count) / static_cast<double>(most));
    const bool room_above = *bin.frequency() < 0.9;
    lines += fmt::format("{} {} {:.3f} {} {}\n", *bin.mean_belief(), *bin.frequency(), size, count_text(bin.count),
                         *bin.frequency() + (room_above ? 0.055 : -0.06));
  }
  std::string text = "set arrow from first 0,0 to first 1,1 nohead dt 3 lw 1 lc rgb '#8c8c8c' back\n";
  if (lines.empty()) return text + "plot -9 notitle\n";
  return text + block("BINS", lines) +
         fmt::format(
             "plot $BINS using 1:2 with lines lw 1 lc rgb '{0}', \\\n"
             "     $BINS using 1:2:3 with points pt 7 ps variable lc rgb '{0}', \\\n"
             "     $BINS using 1:5:4 with labels center font ',{1}' textcolor rgb '#444444'\n",
             belief_colour, note_font);
}

}  // namespace

std::string belief_path_script(const BeliefPathPlot& plot, PictureFormat format) {
  if (plot.match.empty()) throw UsageError("a picture of beliefs needs a round");
  const std::size_t rounds = std::min(plot.match.size(), most_drawn_rounds);
  const Layout layout = belief_path_layout(plot);
  return opening(format, layout, plot.title, plot.caption) + belief_path_axes(layout, rounds) +
         belief_path_layers(belief_lines(plot.match, rounds), rounds);
}

std::string accuracy_script(const AccuracyPlot& plot, PictureFormat format) {
  const std::size_t n = plot.names.size();
  if (n == 0) throw UsageError("a picture of accuracy needs at least one opponent");
  if (n > most_plotted)
    throw UsageError(fmt::format("{} opponents are too many for a picture: at most {}", n, most_plotted));
  if (plot.shares.size() != n) throw UsageError(fmt::format("{} opponents and {} accuracies", n, plot.shares.size()));
  const Layout layout = accuracy_layout(plot);
  std::string axes = plain_axes() + fmt::format("set xrange [0:100]\nset yrange [{}:-0.7]\nset grid noytics\n",
                                                static_cast<double>(n) - 0.3);
  axes += name_tics("ytics", plot.names, std::min(text_font, row_height(n) - 1.5), "nomirror");
  axes += "set xtics 20\n" + axis_name(layout, "rounds in which the likelier move was played, %");
  return opening(format, layout, plot.title, plot.caption) + axes + accuracy_bars(plot);
}

std::string calibration_script(const CalibrationPlot& plot, PictureFormat format) {
  const Layout layout = calibration_layout(plot);
  std::string axes = plain_axes() + "set xrange [-0.05:1.05]\nset yrange [-0.05:1.05]\nset xtics 0.2\nset ytics 0.2\n";
  axes +=
      axis_name(layout, "belief P(C), mean of each tenth") + side_name(layout, "share of rounds in which C was played");
  axes += fmt::format(
      "set label 'numbers: rounds of each tenth; dotted: perfect calibration' at {},{} center font ',{}' textcolor rgb "
      "'#444444'\n",
      layout.x((layout.left + layout.right) / 2), layout.y(layout.bottom + 74), note_font);
  return opening(format, layout, plot.title, plot.caption) + axes + calibration_bins(plot);
}

void draw(const BeliefPathPlot& plot, const fs::path& path) {
  draw_script(path, plot.title, [&](PictureFormat format) { return belief_path_script(plot, format); });
}

void draw(const AccuracyPlot& plot, const fs::path& path) {
  draw_script(path, plot.title, [&](PictureFormat format) { return accuracy_script(plot, format); });
}

void draw(const CalibrationPlot& plot, const fs::path& path) {
  draw_script(path, plot.title, [&](PictureFormat format) { return calibration_script(plot, format); });
}

}  // namespace folk
