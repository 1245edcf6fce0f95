#include <folk/tools/payoff_region/question.h>

#include <folk/tools/choices/criterion_option.h>
#include <folk/tools/choices/game_option.h>
#include <folk/tools/choices/play_options.h>
#include <folk/tools/choices/standard_names.h>
#include <folk/tools/program/threads_option.h>

#include <fmt/format.h>
#include <folk/games/error.h>
#include <folk/games/payoffs.h>
#include <folk/games/stage_games/nfg.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace folk::tools {
namespace {

/// Options that say how a tournament is played: without --strategies they would do nothing.
constexpr std::array tournament_options{"include", "rounds",      "criterion", "end-probability", "noise",
                                        "sample",  "extrapolate", "seed",      "threads"};

/// The game and its title.
std::pair<StageGame, std::string> any_game(const po::variables_map& values, const Common& common) {
  if (values.count("game") == 0) {
    const ChosenGame chosen = chosen_game(values);
    note_unusual_payoffs(chosen, common);
    return {stage_game(chosen.payoffs), fmt::format("{} ({})", chosen.title, to_text(chosen.payoffs))};
  }
  if (values.count("payoffs") != 0) throw UsageError("--game and --payoffs contradict: give one of them");
  StageGame game = named_game(values);
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
                                                  const Common& common, const Progress& progress) {
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
  const Tournament tournament = play_tournament(std::move(entrants), settings, progress);
  return RegionTournament{text_option(values, "strategies"),
                          text_option(values, "include"),
                          settings.criterion.to_string(),
                          settings.noise,
                          settings.seed,
                          tournament.size(),
                          pairs_of(tournament),
                          tournament.caveats()};
}

}  // namespace

RegionReport region_report(const po::variables_map& values, const Common& common, const Progress& progress) {
  auto [game, title] = any_game(values, common);
  const auto discount = chosen_discount(values);
  require_small_for_region(game);
  auto tournament = chosen_tournament(values, game, common, progress);
  RegionReport report{game, title, std::nullopt, payoff_region(game), std::nullopt, std::move(tournament)};
  if (game.rows() + game.columns() <= most_equilibrium_actions) report.equilibria = stage_equilibria(game);
  if (discount) report.set = pure_equilibrium_set(game, *discount);
  return report;
}

}  // namespace folk::tools
