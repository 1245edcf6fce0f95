#include <folk/tools/ipd_evolve/scores.h>
#include <folk/tools/ipd_evolve/tournament_file.h>

#include <folk/tools/choices/criterion_option.h>
#include <folk/tools/choices/game_option.h>
#include <folk/tools/choices/play_options.h>
#include <folk/tools/choices/roster_option.h>
#include <folk/tools/program/launch.h>
#include <folk/tools/program/number_text.h>

#include <fmt/format.h>
#include <folk/analysis/tournament/tournament.h>
#include <folk/games/error.h>

#include <algorithm>
#include <optional>

namespace folk::tools {
namespace {

/// Options that say what is played, and have no say in what a file holds.
constexpr const char* played_options[] = {"strategies", "include", "exclude",     "rounds",
                                          "criterion",  "payoffs", "game",        "end-probability",
                                          "noise",      "sample",  "extrapolate", "repetitions"};

void refuse_beside_file(const po::variables_map& values) {
  for (const char* option : played_options)
    if (values.count(option) != 0 && !values[option].defaulted())
      throw UsageError(fmt::format("--tournament and --{} contradict: the file says what was played", option));
}

PlayedScores played(Tournament tournament, const ChosenGame& game, const po::variables_map& values) {
  const auto& settings = tournament.settings();
  PlayedScores found;
  found.scores = std::make_shared<ScoreMatrix>(tournament);
  const auto included = text_option(values, "include");
  found.roster = text_option(values, "strategies") + (included.empty() ? "" : ", with " + included);
  const std::string words = game_words(game.title, settings.payoffs);
  found.line =
      fmt::format("game {}, {}, noise {}", words, settings.criterion.to_string(), to_short_text(settings.noise));
  found.caption = {words, settings.criterion.to_string(), settings.noise};
  bool sampled = false;
  for (const auto& entry : tournament.ranking()) sampled = sampled || entry.method == Method::sampled;
  if (sampled) found.line += fmt::format(", repetitions {}", settings.repetitions.count());
  found.members = {{"roster", json_string(text_option(values, "strategies"))},
                   {"included", json_string(included)},
                   {"game", json_string(game.title)},
                   {"payoffs", json_string(to_text(settings.payoffs))},
                   {"criterion", json_string(settings.criterion.to_string())},
                   {"noise", fmt::format("{}", settings.noise.probability())},
                   {"repetitions", fmt::format("{}", settings.repetitions.count())}};
  found.caveats = tournament.caveats();
  if (sampled)
    found.caveats.emplace_back("some scores were sampled: what becomes of the populations depends on the seed");
  return found;
}

}  // namespace

void add_score_options(po::options_description& options) {
  auto add = options.add_options();
  const auto text = [] { return po::value<std::string>(); };
  add("strategies", text()->default_value("classics"), "the roster: SPEC");
  add("include", text(), "SPEC of entrants beside the roster");
  add("exclude", text(), "SPEC of strategies to leave out");
  add_criterion_options(options);
  add("noise", text()->default_value("0"), "each move flips with this probability, from 0 to 1");
  add_game_options(options);
  add_play_options(options);
  add("repetitions", text(), "matches of a pair that can only be sampled (default 100)");
  add("tournament", text(),
      "take the scores from this file instead: what ipd-tournament writes with --format json or as scores.csv");
}

PlayedScores chosen_scores(const po::variables_map& values, const Common& common, std::uint64_t seed, unsigned threads,
                           const Progress& progress) {
  if (values.count("tournament") != 0) {
    refuse_beside_file(values);
    return read_tournament_file(text_option(values, "tournament"));
  }
  const ChosenGame game = chosen_game(values);
  TournamentSettings settings;
  settings.payoffs = game.payoffs;
  settings.criterion = chosen_criterion(values);
  settings.noise = parse_number(text_option(values, "noise"), "--noise", 0, 1);
  settings.repetitions = whole_option(values, "repetitions", 100, 1, 10'000'000);
  settings.seed = seed;
  settings.threads = threads;
  auto [entrants, core] = chosen_field(values, game.payoffs);
  note_unusual_payoffs(game, common);
  return played(play_tournament(std::move(entrants), core, settings, progress, crew()), game, values);
}

}  // namespace folk::tools
