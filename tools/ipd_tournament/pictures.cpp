#include <folk/tools/choices/game_option.h>
#include <folk/tools/ipd_tournament/pictures.h>

#include <fmt/format.h>
#include <folk/analysis/pictures/invasion_picture.h>
#include <folk/analysis/pictures/plots.h>
#include <folk/games/utf8.h>

#include <cstddef>
#include <limits>
#include <vector>

namespace folk::tools {
namespace {

/// A roster may be a long list: a picture's title has room for its beginning.
constexpr std::size_t longest_roster = 60;

std::string invasion_title(const TournamentLabels& labels) {
  std::string roster = visible_text(labels.roster, longest_roster);
  if (!labels.included.empty()) roster += ", with " + visible_text(labels.included, longest_roster);
  return "Who can invade whom: " + roster;
}

}  // namespace

void require_pictures(std::size_t strategies, bool with_invasions) {
  require_plotter(strategies);
  if (with_invasions) require_invasion_picture(strategies);
}

void draw_pictures(const std::filesystem::path& folder, const Tournament& tournament, const TournamentLabels& labels,
                   const Invasions* invasions, const PictureChoice& choice) {
  const auto& settings = tournament.settings();
  const double weight = settings.criterion.total_weight();
  const Caption caption{game_words(labels.game, settings.payoffs), settings.criterion.to_string(),
                        settings.noise.probability()};
  std::vector<std::string> names;
  for (const auto& entry : tournament.ranking()) names.push_back(tournament.name(entry.entrant));
  const auto entrant = [&](std::size_t place) { return tournament.ranking()[place].entrant; };
  const auto a_round = [&](auto figure) {
    return [&tournament, entrant, figure, weight](std::size_t row, std::size_t column) {
      const std::size_t i = entrant(row);
      const std::size_t j = entrant(column);
      return tournament.played(i, j) ? figure(i, j) / weight : std::numeric_limits<double>::quiet_NaN();
    };
  };
  const auto file = [&](const char* name) { return folder / fmt::format("{}.{}", name, choice.extension); };
  const auto score = a_round([&](std::size_t i, std::size_t j) { return tournament.score(i, j); });
  const auto cooperation = a_round([&](std::size_t i, std::size_t j) { return tournament.cooperation(i, j); });
  draw(HeatMap{names, score, "Payoff a round, row against column", "payoff a round", choice.scale, caption},
       file("payoffs"));
  draw(HeatMap{names, cooperation, "Cooperation rate, row against column", "share of C",
               std::array<double, 2>{0.0, 1.0}, caption},
       file("cooperation"));
  draw(BoxPlot{names, score, "Payoff a round over all opponents", "payoff a round", caption}, file("scores"));
  if (invasions == nullptr) return;
  std::vector<std::string> roster;
  for (std::size_t i = 0; i < tournament.size(); ++i) roster.push_back(tournament.name(i));
  draw_invasions(*invasions, roster, invasion_title(labels), caption, file("invasion"));
}

}  // namespace folk::tools
