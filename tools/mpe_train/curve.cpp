#include <folk/tools/mpe_train/curve.h>

#include <folk/tools/program/output_file.h>
#include <folk/tools/program/program.h>

#include <fmt/format.h>
#include <folk/analysis/pictures/gnuplot_script.h>
#include <folk/games/criterion.h>
#include <folk/games/error.h>
#include <folk/mpe/pictures/curve_file.h>
#include <folk/strategies/registry.h>

#include <filesystem>
#include <string>
#include <vector>

namespace folk::tools {
namespace {

Program curve_program() {
  Program program;
  program.name = "mpe-train curve";
  program.title = "draws how training runs went";
  program.usage = "FILE.csv... --output FILE.svg [options]";
  program.summary = "Draws the evaluations of training runs, a line a run: the CSVs that mpe-train online writes.";
  program.examples = {"mpe-train curve run-1.csv run-2.csv run-3.csv --output runs.svg --title 'three seeds'",
                      "mpe-train curve run-1.csv --mark published=185.6,lead_pursuit=230.3 --output run.png"};
  auto add = program.options.add_options();
  add("output", po::value<std::string>(), ".svg, .png or .pdf (needed)");
  add("title", po::value<std::string>(), "over the picture");
  add("mark", po::value<std::string>(), "NAME=RETURN[,...]: dashed lines to hold the runs against");
  add("prey", "the prey's returns instead of the predators'");
  program.arguments.add_options()("files", po::value<std::vector<std::string>>(), "");
  program.positional.add("files", -1);
  return program;
}

int draw_curves(const po::variables_map& values, const Common&) {
  if (values.count("files") == 0) throw UsageError("which runs? give the CSVs that mpe-train online wrote");
  const std::filesystem::path output = text_option(values, "output");
  if (output.empty()) throw UsageError("--output FILE.svg is missing");
  gnuplot::picture_format(output);
  require_writable(output, "--output");
  mpe::LearningCurvePlot plot;
  plot.title = text_option(values, "title");
  const bool prey = values.count("prey") != 0;
  plot.unit = prey ? "return of the prey" : "return of one predator";
  for (const auto& file : values["files"].as<std::vector<std::string>>())
    plot.curves.push_back(mpe::read_curve(file, prey ? "prey_return" : "return"));
  for (const auto& mark : split_list(text_option(values, "mark"))) {
    const auto sign = mark.find('=');
    if (sign == std::string::npos)
      throw UsageError(fmt::format("--mark '{}': expected NAME=RETURN, as in published=185.6", excerpt(mark)));
    plot.marks.push_back({mark.substr(0, sign), parse_number(mark.substr(sign + 1), "--mark", -1e15, 1e15)});
  }
  draw(plot, output);
  return done;
}

}  // namespace

int mpe_curve(int argc, char** argv) { return run(argc, argv, curve_program(), {}, draw_curves); }

}  // namespace folk::tools
