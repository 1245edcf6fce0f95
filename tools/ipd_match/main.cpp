// ipd-match: one match, move by move.

#include <fmt/format.h>
#include <folk/games/criterion.h>
#include <folk/games/error.h>

#include <functional>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

#include <folk/tools/choices/play_options.h>
#include <folk/tools/choices/standard_names.h>
#include <folk/tools/ipd_match/output.h>
#include <folk/tools/program/program.h>
#include <folk/tools/program/progress.h>

namespace folk::tools {
namespace {

/// Every move is kept and written; a longer match is a matter for totals alone.
constexpr std::uint64_t most_rounds = 1'000'000;

std::uint64_t rounds_option(const po::variables_map& values) {
  const std::string text = text_option(values, "rounds");
  if (whole_number(text).value_or(0) > most_rounds)
    throw UsageError(fmt::format(
        "--rounds {}: ipd-match writes every move of at most {} rounds; ipd-tournament takes more", text, most_rounds));
  return whole_option(values, "rounds", 30, 1, most_rounds);
}

MatchSettings settings_of(const po::variables_map& values) {
  MatchSettings settings;
  const auto players =
      values.count("player") != 0 ? values["player"].as<std::vector<std::string>>() : std::vector<std::string>{};
  if (players.size() != 2)
    throw UsageError(
        fmt::format("a match needs two strategies, not {}: try ipd-match tit_for_tat prober", players.size()));
  settings.players = {players[0], players[1]};
  settings.game = chosen_game(values);
  settings.rounds = rounds_option(values);
  settings.noise = parse_number(text_option(values, "noise", "0"), "--noise", 0, 1);
  settings.policies = chosen_play_options(values);
  settings.seed = whole_option(values, "seed", 1, 0, std::numeric_limits<std::uint64_t>::max());
  return settings;
}

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
  const MatchSettings settings = settings_of(values);
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
