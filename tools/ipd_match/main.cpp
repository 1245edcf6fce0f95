// ipd-match: one match, move by move.

#include <functional>
#include <iostream>
#include <string>
#include <vector>

#include <folk/tools/choices/play_options.h>
#include <folk/tools/choices/standard_names.h>
#include <folk/tools/ipd_match/output.h>
#include <folk/tools/ipd_match/settings.h>
#include <folk/tools/program/program.h>
#include <folk/tools/program/progress.h>

namespace folk::tools {
namespace {

Program ipd_match() {
  Program program;
  program.name = "ipd-match";
  program.title = "one match, move by move";
  program.usage = "A B [options]";
  program.summary =
      "Plays one match and prints every move. A and B are strategies (see ipd-strategies list), @FILE#MACHINE\n"
      "or exec:\"COMMAND\"; LABEL=NAME renames it, @- is a file on the standard input. A strategy can play itself.";
  program.examples = {"ipd-match tit_for_tat prober", "ipd-match gradual \"random(0.5)\" --rounds 100 --seed 7",
                      "ipd-match pavlov pavlov --noise 0.05", "ipd-match spiteful mistrust --format json"};
  auto add = program.options.add_options();
  add("rounds", po::value<std::string>(), "how many rounds, 1 to 1000000 (default 30)");
  add("noise", po::value<std::string>(), "the probability that a move flips (default 0)");
  add_game_options(program.options);
  add_play_options(program.options);
  add("seed", po::value<std::string>(), "of all random numbers (default 1)");
  add("width", po::value<std::string>(), "columns of the text (default: the terminal's, else 80)");
  program.arguments.add_options()("player", po::value<std::vector<std::string>>());
  program.positional.add("player", 2);
  program.registry = [] { return standard_names(); };
  return program;
}

int match(const po::variables_map& values, const Common& common) {
  const MatchSettings settings = chosen_match(values);
  Sheet sheet = sheet_of_stdout();
  sheet.width = whole_option(values, "width", sheet.width, 20, 100'000);
  note_unusual_payoffs(settings.game, common);
  const MatchRecord record = [&] {
    ProgressBar progress("playing", !common.quiet);
    return play_one(settings, std::ref(progress));
  }();
  switch (common.format) {
    case Format::text: write_text(std::cout, settings, record, sheet); break;
    case Format::csv: write_csv(std::cout, settings, record); break;
    case Format::json: write_json(std::cout, settings, record); break;
  }
  return done;
}

}  // namespace
}  // namespace folk::tools

int main(int argc, char** argv) {
  return folk::tools::run(argc, argv, folk::tools::ipd_match(), {"text", "csv", "json"}, folk::tools::match);
}
