#include <folk/tools/ipd_match/settings.h>

#include <folk/tools/choices/play_options.h>

#include <fmt/format.h>
#include <folk/games/criterion.h>
#include <folk/games/error.h>

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

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

}  // namespace

MatchSettings chosen_match(const po::variables_map& values) {
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

}  // namespace folk::tools
