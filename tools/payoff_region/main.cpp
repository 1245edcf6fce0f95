// payoff-region: what a repeated game can pay, what each player can secure, and what patience makes an equilibrium.

#include <folk/tools/choices/criterion_option.h>
#include <folk/tools/choices/game_option.h>
#include <folk/tools/choices/play_options.h>
#include <folk/tools/choices/standard_names.h>
#include <folk/tools/payoff_region/output.h>
#include <folk/tools/program/program.h>
#include <folk/tools/program/progress.h>
#include <folk/tools/program/threads_option.h>

#include <fmt/format.h>
#include <folk/analysis/pictures/gnuplot_script.h>
#include <folk/games/error.h>
#include <folk/games/payoffs.h>
#include <folk/games/stage_games/nfg.h>

#include <algorithm>
#include <array>
#include <functional>
#include <iostream>
#include <optional>

namespace folk::tools {
namespace {

/// Options that say how a tournament is played: without --strategies they would do nothing.
constexpr std::array tournament_options{"include", "rounds",      "criterion", "end-probability", "noise",
                                        "sample",  "extrapolate", "seed",      "threads"};

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

/// The game and its title.
std::pair<StageGame, std::string> any_game(const po::variables_map& values, const Common& common) {
  if (values.count("game") == 0) {
    const ChosenGame chosen = chosen_game(values);
    note_unusual_payoffs(chosen, common);
    return {stage_game(chosen.payoffs), fmt::format("{} ({})", chosen.title, to_text(chosen.payoffs))};
  }
  if (values.count("payoffs") != 0) throw UsageError("--game and --payoffs contradict: give one of them");
  StageGame game = read_game(text_option(values, "game"));
  std::string title = game.title().empty() ? "game without a title" : game.title();
  return {std::move(game), std::move(title)};
}

/// 0.9 or 9/10.
std::optional<Rational> chosen_discount(const po::variables_map& values) {
  if (values.count("discount") == 0) return std::nullopt;
  return Criterion::discounted(parse_exact_number(text_option(values, "discount"), "--discount", 0, 1))
      .exact_continuation();
}

std::vector<Strategy> entrants_of(const po::variables_map& values, const Payoffs& payoffs) {
  const Registry registry = standard_names(chosen_play_options(values));
  auto entrants = registry.roster(text_option(values, "strategies"), payoffs);
  if (values.count("include") == 0) return entrants;
  return with_guests(registry, std::move(entrants), text_option(values, "strategies"), text_option(values, "include"),
                     payoffs);
}

/// The pairs of a finished tournament, the earlier in the roster as the row player.
std::vector<PairPayoffs> pairs_of(const Tournament& tournament) {
  const double weight = tournament.settings().criterion.total_weight();
  std::vector<PairPayoffs> pairs;
  for (std::size_t i = 0; i < tournament.size(); ++i)
    for (std::size_t j = i; j < tournament.size(); ++j)
      pairs.push_back(
          {tournament.name(i), tournament.name(j), {tournament.score(i, j) / weight, tournament.score(j, i) / weight}});
  return pairs;
}

std::optional<RegionTournament> chosen_tournament(const po::variables_map& values, const StageGame& game,
                                                  const Common& common) {
  if (values.count("strategies") == 0) {
    for (const char* option : tournament_options)
      if (values.count(option) != 0)
        throw UsageError(fmt::format("--{} is about a tournament: name its roster with --strategies", option));
    return std::nullopt;
  }
  TournamentSettings settings;
  settings.payoffs = symmetric_payoffs(game);
  settings.criterion = chosen_criterion(values);
  settings.noise = values.count("noise") == 0 ? 0 : parse_number(text_option(values, "noise"), "--noise", 0, 1);
  settings.seed = whole_option(values, "seed", 1, 0, ~std::uint64_t{0});
  settings.threads = threads_option(values, common);
  auto entrants = entrants_of(values, settings.payoffs);
  ProgressBar bar(fmt::format("playing {} strategies", entrants.size()), !common.quiet);
  const Tournament tournament = play_tournament(std::move(entrants), settings, std::ref(bar));
  return RegionTournament{text_option(values, "strategies"),
                          text_option(values, "include"),
                          settings.criterion.to_string(),
                          settings.noise,
                          settings.seed,
                          tournament.size(),
                          pairs_of(tournament),
                          tournament.caveats()};
}

int payoff_region_program(const po::variables_map& values, const Common& common) {
  auto [game, title] = any_game(values, common);
  const auto discount = chosen_discount(values);
  require_small_for_region(game);
  const std::string picture = text_option(values, "output");
  if (values.count("output") != 0) {
    gnuplot::picture_format(picture);
    gnuplot::require_gnuplot();
  }
  auto tournament = chosen_tournament(values, game, common);
  RegionReport report{game, title, std::nullopt, payoff_region(game), std::nullopt, std::move(tournament)};
  if (game.rows() + game.columns() <= most_equilibrium_actions) report.equilibria = stage_equilibria(game);
  if (discount) report.set = pure_equilibrium_set(game, *discount);
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
