#pragma once
// A payoff region as text, CSV, JSON and a picture.

#include <folk/analysis/folk_theorem/equilibrium_set.h>
#include <folk/analysis/folk_theorem/payoff_region.h>
#include <folk/analysis/tournament/tournament.h>
#include <folk/games/stage_games/stage_equilibria.h>

#include <array>
#include <filesystem>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace folk::tools {

/// What a round pays the two players of a match on average.
struct PairPayoffs {
  std::string first;
  std::string second;
  Point<double> payoffs{};
};

/// A tournament whose pairs are dots in the region.
struct RegionTournament {
  std::string roster;    ///< the SPEC as the user wrote it
  std::string included;  ///< the --include SPEC, or nothing
  std::string criterion;
  Noise noise;
  std::uint64_t seed = 0;
  std::size_t strategies = 0;
  std::vector<PairPayoffs> pairs;  ///< each pair once, copies of one strategy among them
  std::vector<std::string> notes;  ///< what a reader must know of the figures
};

/// All that payoff-region found.
struct RegionReport {
  StageGame game;
  std::string title;                          ///< of the game, as its author wrote it
  std::optional<StageEquilibria> equilibria;  ///< nothing: the game has too many actions
  PayoffRegion region;
  std::optional<EquilibriumSet> set;  ///< nothing: no discount factor was given
  std::optional<RegionTournament> tournament;
};

void write_text(std::ostream& out, const RegionReport& report);

/// kind,first,second,row,column: a line a corner, a point, a stage equilibrium or a pair.
void write_csv(std::ostream& out, const RegionReport& report);

/// One object; exact numbers are the nearest doubles, mixtures also fractions as text.
void write_json(std::ostream& out, const RegionReport& report);

/// The names of the two players as text and pictures show them, also those of players without one.
std::array<std::string, 2> shown_players(const StageGame& game);

/// "2/3 Swerve + 1/3 Straight".
std::string mixture_text(const MixedAction& mixture, const std::vector<std::string>& actions);

/// The picture, in the format that the path's extension says. Throws as folk::draw does.
void draw_picture(const std::filesystem::path& path, const RegionReport& report);

}  // namespace folk::tools
