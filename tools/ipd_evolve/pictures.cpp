#include <folk/tools/ipd_evolve/pictures.h>
#include <folk/tools/program/picture_option.h>

#include <fmt/format.h>
#include <folk/analysis/pictures/fixation_drawing.h>
#include <folk/analysis/pictures/gnuplot_script.h>
#include <folk/analysis/pictures/plots.h>
#include <folk/analysis/pictures/population_plot.h>
#include <folk/analysis/pictures/simplex_plot.h>
#include <folk/games/error.h>

#include <cmath>
#include <limits>

namespace folk::tools {
namespace {

namespace fs = std::filesystem;

PictureFormat format_of(const std::string& extension) {
  return extension == "svg" ? PictureFormat::svg : extension == "png" ? PictureFormat::png : PictureFormat::pdf;
}

/// A long roster would make a wide picture.
std::string title_of(const PlayedScores& played, const std::string& model) {
  return fmt::format("{}: {}", excerpt(played.roster, 60), model);
}

SimplexPlot simplex_of(const EvolutionReport& report) {
  const auto& scores = *report.played.scores;
  SimplexPlot plot;
  plot.title = title_of(report.played, report.question.model);
  plot.caption = report.played.caption;
  for (std::size_t i = 0; i < 3; ++i) {
    plot.names[i] = scores.names()[i];
    for (std::size_t j = 0; j < 3; ++j) plot.payoffs[i][j] = scores.payoff(i, j);
  }
  for (const auto& [generation, population] : report.evolution.state().history.rows()) {
    const double all = population[0] + population[1] + population[2];
    plot.way.push_back({population[0] / all, population[1] / all, population[2] / all});
  }
  return plot;
}

}  // namespace

std::optional<std::string> chosen_picture(const po::variables_map& values) {
  const auto extension = picture_extension(values);
  if (!extension) return std::nullopt;
  if (values.count("runs") != 0) throw UsageError("--plot and --runs contradict: there is no picture of who took over");
  gnuplot::require_gnuplot();
  if (values.count("fixation") != 0 || values.count("stationary") != 0) run_renderer({"dot", "-V"}, "", "graphviz");
  return extension;
}

void draw_evolution(const fs::path& folder, const EvolutionReport& report, const std::string& extension) {
  const auto& evolution = report.evolution;
  PopulationPlot plot;
  plot.names = report.played.scores->names();
  for (const auto& entry : evolution.ranking()) plot.ranking.push_back(entry.entrant);
  plot.rows = evolution.state().history.rows();
  plot.title = title_of(report.played, report.question.model);
  plot.caption = report.played.caption;
  plot.shares = report.question.dynamics->has_shares();
  draw_lines(plot, folder / ("populations." + extension));
  draw_stack(plot, folder / ("stack." + extension));
  if (report.played.scores->has_cooperation()) {
    CooperationPlot cooperation;
    cooperation.title = plot.title;
    cooperation.caption = plot.caption;
    for (const auto& [generation, population] : plot.rows)
      cooperation.shares.emplace_back(generation, report.cooperation(population).value_or(0));
    draw(cooperation, folder / ("cooperation." + extension));
  }
  if (plot.names.size() == 3) draw(simplex_of(report), folder / ("simplex." + extension));
}

void require_fixation_picture(std::size_t strategies) {
  if (strategies > most_plotted)
    throw UsageError(
        fmt::format("--plot: {} strategies are too many for a picture: at most {}", strategies, most_plotted));
}

void draw_fixation(const fs::path& folder, const FixationReport& report, const std::string& extension) {
  const auto path = folder / ("fixation." + extension);
  const auto& names = report.played.scores->names();
  const auto title =
      fmt::format("{}, N = {}", title_of(report.played, report.question.rules.text()), report.fixation.population);
  if (names.size() <= most_drawn_fixations) {
    render_dot(to_dot(report.fixation, report.distribution, names, title, report.played.caption), path,
               format_of(extension));
    return;
  }
  const auto value = [&](std::size_t resident, std::size_t mutant) {
    if (resident == mutant) return std::numeric_limits<double>::quiet_NaN();
    return std::max(std::log10(report.fixation.ratio(mutant, resident)), -12.0);
  };
  draw(HeatMap{names, value, title + "; residents in rows", "log10 of N x probability", std::nullopt,
               report.played.caption},
       path);
}

}  // namespace folk::tools
