// ipd-tournament: the round robin of a roster.

#include <folk/tools/choices/criterion_option.h>
#include <folk/tools/choices/game_option.h>
#include <folk/tools/choices/play_options.h>
#include <folk/tools/choices/roster_option.h>
#include <folk/tools/choices/standard_names.h>
#include <folk/tools/ipd_tournament/classes.h>
#include <folk/tools/ipd_tournament/output.h>
#include <folk/tools/ipd_tournament/pictures.h>
#include <folk/tools/ipd_tournament/settings.h>
#include <folk/tools/ipd_tournament/sub_roster_output.h>
#include <folk/tools/program/launch.h>
#include <folk/tools/program/output_folder.h>
#include <folk/tools/program/picture_option.h>
#include <folk/tools/program/piece_file.h>
#include <folk/tools/program/program.h>
#include <folk/tools/program/progress.h>

#include <fmt/format.h>
#include <folk/games/error.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iostream>
#include <optional>

namespace folk::tools {
namespace {

Program program() {
  Program program;
  program.name = "ipd-tournament";
  program.title = "the round robin of a roster";
  program.usage = "[options]";
  program.summary =
      "Plays every strategy of a roster against every other and itself, exactly wherever that can be done,\n"
      "and prints the ranking. SPEC is a comma list of names, rosters (classics, sct2025, all), families\n"
      "(memory(1,2)), genotypes (mem12_ccCDCDDCDD), @FILE (@- is the standard input) and exec:\"CMD\"; LABEL=NAME\n"
      "renames one of them. 'ipd-strategies list' shows all. A complete class alone is ranked as a whole, up to\n"
      "memory(2,2); --class scores entrants against all members of one, up to memory(4,4), without listing them.\n"
      "Under mpirun or srun the ranks share the work; the results do not depend on it.";
  program.examples = {"ipd-tournament",
                      "ipd-tournament --strategies pavlov,tit_for_tat,all_d --rounds 1000",
                      "ipd-tournament --include @examples/my_strategies.machines --noise 0.01 --output results --plot",
                      "ipd-tournament --strategies 'memory(1,2)' --rounds 1000 --format csv",
                      "ipd-tournament --strategies 'memory(2,2)' --rounds 1000 --output results",
                      "ipd-tournament --class 'memory(3,3)' --entrants tit_for_tat,pavlov,winner12",
                      "ipd-tournament --criterion discounted:0.9 --payoffs T=4,R=3,P=1,S=0 --format json",
                      "mpirun -n 4 ipd-tournament --strategies 'memory(2,2)' --rounds 1000 --journal run.journal"};
  program.shares_work = true;
  auto add = program.options.add_options();
  const auto text = [] { return po::value<std::string>(); };
  add("strategies", text()->default_value("classics"), "the roster: SPEC");
  add("include", text(), "SPEC of entrants beside the roster; payoffs are normalised by the roster alone");
  add("exclude", text(), "SPEC of strategies to leave out");
  add("class", text(), "memory(X,Y): score --entrants against all its members instead of playing a round robin");
  add("by-behaviour", "of a complete class: a row for all members that no opponent can tell apart");
  add("entrants", text(), "SPEC of those that meet the class (default classics)");
  add("most-kinds", text(), "an entrant that tells more kinds of members apart is left out (default 1000000000)");
  add_criterion_options(program.options);
  add("noise", text()->default_value("0"), "each move flips with this probability, from 0 to 1");
  add_game_options(program.options);
  add_play_options(program.options);
  add("no-self-play", "nobody meets its own copy");
  add("invasion", "also tell who can invade whom, and who is evolutionarily stable");
  add("sub-rosters", text(),
      "N[:SAMPLES]: also rank each strategy in the smaller tournaments of N of them: in all, or of more than SAMPLES "
      "(default 1000000) in so many that are drawn");
  add("repetitions", text(), "matches of a pair that can only be sampled (default 100)");
  add("seed", text(), "of all random numbers (default 1)");
  add("threads", text(), "threads (default: one a processor); the results do not depend on it");
  add("journal", text(), "file to which finished work is added: after a kill the same command goes on from it");
  add("output", text(),
      "folder for ranking.csv, scores.csv, cooperation.csv, pairs.csv, summary.json, and beliefs.csv, "
      "belief_log_loss.csv, invasion.csv, sub_rosters.csv where there are any");
  add("plot", text()->implicit_value("svg"),
      "svg, png or pdf: also draw payoffs, cooperation, scores (and the invasions) into --output");
  add("scale", text(), "payoffs a round of the end colours of payoffs, a heat map, so that two can be compared");
  program.registry = [] { return standard_names(); };
  return program;
}

/// A text without the blanks around it.
std::string without_blanks(const std::string& text) {
  const auto first = text.find_first_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') + 1 - first);
}

/// The MIN,MAX of --scale, if it is given.
std::optional<std::array<double, 2>> chosen_scale(const po::variables_map& values) {
  if (values.count("scale") == 0) return std::nullopt;
  const std::string text = text_option(values, "scale");
  const auto refused = [&] {
    return UsageError(fmt::format(
        "--scale '{}': expected MIN,MAX, two finite numbers, the second the greater, as in 0,5", excerpt(text)));
  };
  const auto comma = text.find(',');
  if (comma == std::string::npos || text.find(',', comma + 1) != std::string::npos) throw refused();
  constexpr double largest = 1e15;
  std::array<double, 2> scale{};
  try {
    scale = {parse_number(without_blanks(text.substr(0, comma)), "--scale", -largest, largest),
             parse_number(without_blanks(text.substr(comma + 1)), "--scale", -largest, largest)};
  } catch (const UsageError&) {
    throw refused();
  }
  // Nearer ends than this no colour tells apart, nor gnuplot.
  const double least = 1e-9 * std::max(std::abs(scale[0]), std::abs(scale[1]));
  if (!(scale[1] - scale[0] > least)) throw refused();
  return scale;
}

/// How pictures are drawn, if they are, once it is clear that so many strategies can be drawn here.
std::optional<PictureChoice> chosen_pictures(const po::variables_map& values, std::size_t strategies) {
  const auto scale = chosen_scale(values);
  const auto extension = picture_extension(values);
  if (!extension) {
    if (scale) throw UsageError("--scale is about the heat map of payoffs: draw it with --plot --output DIR");
    return std::nullopt;
  }
  require_pictures(strategies, values.count("invasion") != 0);
  return PictureChoice{*extension, scale};
}

int tournament(const po::variables_map& values, const Common& common) {
  if (values.count("class") != 0) return score_entrants(values, common);
  if (values.count("entrants") != 0)
    throw UsageError("--entrants needs the class that they meet: --class 'memory(X,Y)'");
  if (const auto members = whole_class(values)) return rank_class(*members, values, common);
  const ChosenGame game = chosen_game(values);
  const TournamentSettings settings = chosen_settings(values, common, game.payoffs);
  if (values.count("invasion") != 0 && !settings.self_play)
    throw UsageError("--invasion needs what each earns against its own copy: leave out --no-self-play");
  Field field = chosen_field(values, game.payoffs);
  auto sub_roster_settings = chosen_sub_rosters(values, field.entrants.size());
  const auto pictures = speaks() ? chosen_pictures(values, field.entrants.size()) : std::nullopt;
  const auto folder = output_folder(values);
  note_unusual_payoffs(game, common);

  std::optional<Tournament> played;
  std::optional<SubRosters> sub_rosters;
  run_kept(values, [&](const auto& ended) {
    ProgressBar bar(fmt::format("playing {} strategies", field.entrants.size()), !common.quiet);
    const Progress progress(std::ref(bar), ended);
    played = play_tournament(std::move(field.entrants), field.core, settings,
                             progress.part(0, sub_roster_settings ? 0.5 : 1), crew());
    if (!sub_roster_settings || !crew().first()) return;
    sub_roster_settings->seed = settings.seed;
    sub_roster_settings->threads = settings.threads;
    sub_rosters = rank_sub_rosters(*played, *sub_roster_settings, progress.part(0.5, 1));
  });
  if (!crew().first()) return done;
  const Tournament& result = *played;

  const TournamentLabels labels{text_option(values, "strategies"), text_option(values, "include"), game.title,
                                common.command};
  const auto invasions = values.count("invasion") != 0 ? std::optional<Invasions>(result) : std::nullopt;
  const TournamentExtras extras{invasions ? &*invasions : nullptr, sub_rosters ? &*sub_rosters : nullptr};
  if (folder) {
    write_files(*folder, result, labels, extras);
    if (pictures) draw_pictures(*folder, result, labels, extras.invasions, *pictures);
  }
  switch (common.format) {
    case Format::text: write_text(std::cout, result, labels, extras); break;
    case Format::csv: write_ranking_csv(std::cout, result, extras); break;
    case Format::json: write_json(std::cout, result, labels, true, extras); break;
  }
  return done;
}

}  // namespace
}  // namespace folk::tools

int main(int argc, char** argv) {
  return folk::tools::run(argc, argv, folk::tools::program(), {"text", "csv", "json"}, folk::tools::tournament);
}
