// strategy-graph: a strategy drawn as an automaton.

#include <fmt/format.h>
#include <folk/analysis/pictures/automaton_picture.h>
#include <folk/games/error.h>
#include <folk/games/text_file.h>

#include <filesystem>
#include <iostream>
#include <optional>

#include <folk/tools/choices/chosen_machine.h>
#include <folk/tools/choices/game_option.h>
#include <folk/tools/choices/standard_names.h>
#include <folk/tools/program/program.h>
#include <folk/tools/strategy_graph/drawn.h>

namespace folk::tools {
namespace {

/// Where the drawing goes; no picture format means DOT text.
struct Output {
  std::string path;
  std::optional<PictureFormat> format;
};

Output output_named(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  if (extension == ".dot") return {path, std::nullopt};
  for (const auto format : {PictureFormat::svg, PictureFormat::png, PictureFormat::pdf})
    if (extension == "." + to_string(format)) return {path, format};
  throw UsageError(fmt::format("-o {}: the extension says the format: .svg, .png, .pdf or .dot", excerpt(path, 200)));
}

Program strategy_graph() {
  Program program;
  program.name = "strategy-graph";
  program.title = "a strategy drawn as an automaton";
  program.usage = "NAME [-o FILE] [options]";
  program.summary =
      "Draws a strategy as its smallest automaton: a circle is a state and holds its move, edges are labelled with\n"
      "their move, or with own/their moves where own moves matter. NAME is a strategy (see ipd-strategies list),\n"
      "@FILE or @FILE#MACHINE, whose states keep their names. Without -o the drawing is printed as DOT.";
  program.examples = {"strategy-graph pavlov -o pavlov.svg", "strategy-graph spiteful --any-own-moves -o spiteful.pdf",
                      "strategy-graph gradual --horizon 6 -o gradual.png",
                      "strategy-graph '@examples/my_strategies.machines#slow_pavlov' -o slow_pavlov.svg"};
  auto add = program.options.add_options();
  add("output,o", po::value<std::string>(), "file to write: .svg, .png, .pdf (these need Graphviz) or .dot");
  add("any-own-moves", "own moves may differ from the machine's own, as noise and deviations make them");
  add("horizon", po::value<std::string>(), "draw the first N rounds (1 to 100); for machines without end");
  add("payoffs", po::value<std::string>(), "T=5,R=3,P=1,S=0 (default): some strategies depend on them");
  program.arguments.add_options()("name", po::value<std::string>());
  program.positional.add("name", 1);
  program.registry = [] { return standard_names(); };
  return program;
}

int draw(const po::variables_map& values, const Common&) {
  const std::string name = text_option(values, "name");
  if (name.empty()) throw UsageError("no strategy named: try strategy-graph pavlov -o pavlov.svg");
  std::optional<Output> output;
  if (values.count("output") != 0) output = output_named(text_option(values, "output"));
  const auto horizon = static_cast<unsigned>(whole_option(values, "horizon", 0, 1, 100));
  const Sense sense = values.count("any-own-moves") != 0 ? Sense::any_own_moves : Sense::own_moves_its_own;
  const std::string payoffs_text = text_option(values, "payoffs");
  const Payoffs payoffs = payoffs_text.empty() ? Payoffs{} : parse_payoffs(payoffs_text);
  const Strategy strategy = chosen_machine(standard_names(), name, payoffs, "drawn");

  const auto [automaton, drawing] = drawn(strategy, name, sense, horizon, payoffs);
  if (!output)
    std::cout << to_dot(automaton, drawing);
  else if (output->format)
    draw_automaton(automaton, drawing, output->path, *output->format);
  else
    write_file(output->path, to_dot(automaton, drawing));
  return done;
}

}  // namespace
}  // namespace folk::tools

int main(int argc, char** argv) {
  return folk::tools::run(argc, argv, folk::tools::strategy_graph(), {}, folk::tools::draw);
}
