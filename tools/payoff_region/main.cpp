// payoff-region: what a repeated game can pay, what each player can secure, and what patience makes an equilibrium.

#include <folk/tools/choices/criterion_option.h>
#include <folk/tools/choices/game_option.h>
#include <folk/tools/choices/play_options.h>
#include <folk/tools/choices/standard_names.h>
#include <folk/tools/payoff_region/output.h>
#include <folk/tools/payoff_region/question.h>
#include <folk/tools/program/program.h>
#include <folk/tools/program/progress.h>

#include <folk/analysis/pictures/gnuplot_script.h>

#include <functional>
#include <iostream>

namespace folk::tools {
namespace {

Program program() {
  Program program;
  program.name = "payoff-region";
  program.title = "what a repeated game can pay, and what patience makes an equilibrium";
  program.usage = "[options]";
  program.summary =
      "Prints the payoffs a round that a repeated game can have: all feasible ones, those that pay each player at\n"
      "least its minmax value and, with --discount, those of its pure-strategy subgame-perfect equilibria with\n"
      "public randomisation (Abreu & Sannikov 2014); also the stage game's own equilibria.";
  program.examples = {"payoff-region --discount 0.6", "payoff-region --game examples/stag_hunt.nfg",
                      "payoff-region --game examples/abreu_sannikov.nfg --discount 0.3 --output region.svg",
                      "payoff-region --discount 0.9 --strategies classics --include sct --output region.png"};
  auto add = program.options.add_options();
  const auto text = [] { return po::value<std::string>(); };
  add("discount", text(), "discount factor, above 0 and below 1: also the equilibrium payoffs");
  add("game", text(), "any two-player game from a .nfg file; - is the standard input");
  add("payoffs", text(), "a prisoner's dilemma (default T=5,R=3,P=1,S=0)");
  add("output", text(), "picture to draw: .svg, .png or .pdf");
  add("strategies", text(), "SPEC of a roster whose tournament's pairs are shown as dots; symmetric 2x2 games only");
  add("include", text(), "SPEC of entrants beside the roster");
  add_criterion_options(program.options);
  add("noise", text(), "each move of the tournament flips with this probability, from 0 to 1 (default 0)");
  add_play_options(program.options);
  add("seed", text(), "of all random numbers of the tournament (default 1)");
  add("threads", text(), "threads (default: one a processor); the results do not depend on it");
  program.registry = [] { return standard_names(); };
  return program;
}

int payoff_region_program(const po::variables_map& values, const Common& common) {
  const std::string picture = text_option(values, "output");
  if (values.count("output") != 0) {
    gnuplot::picture_format(picture);
    gnuplot::require_gnuplot();
  }
  const RegionReport report = [&] {
    ProgressBar bar("playing", !common.quiet);
    return region_report(values, common, std::ref(bar));
  }();
  if (values.count("output") != 0) draw_picture(picture, report);
  switch (common.format) {
    case Format::text: write_text(std::cout, report); break;
    case Format::csv: write_csv(std::cout, report); break;
    case Format::json: write_json(std::cout, report); break;
  }
  return done;
}

}  // namespace
}  // namespace folk::tools

int main(int argc, char** argv) {
  return folk::tools::run(argc, argv, folk::tools::program(), {"text", "csv", "json"},
                          folk::tools::payoff_region_program);
}
