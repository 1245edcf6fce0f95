#pragma once
// One match with everything that happened in it, and what follows from the moves.

#include <folk/tools/choices/game_option.h>

#include <folk/games/noise.h>
#include <folk/games/progress.h>
#include <folk/games/seat.h>
#include <folk/games/transcript.h>
#include <folk/sct/policy/sct_player.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace folk::tools {

/// What is played, with every default filled in.
struct MatchSettings {
  std::array<std::string, 2> players;
  ChosenGame game;
  std::uint64_t rounds = 30;
  Noise noise;
  std::uint64_t seed = 1;
  sct::PlayOptions policies{};  ///< how they play
};

/// All that happened. `caveats` is what a reader must know, each said once. `beliefs` is empty for a player that never
/// told one, NaN in a round where it told none.
struct MatchRecord {
  std::array<std::string, 2> names;
  std::vector<std::string> caveats;
  Transcript transcript;
  std::array<std::vector<bool>, 2> slipped;
  std::array<std::vector<double>, 2> beliefs;

  Move move(Seat seat, std::size_t round) const { return transcript.move(seat, round); }
};

/// Plays the match; tells `progress` the share of rounds that are done. Throws UsageError on an unknown strategy and
/// what the players throw.
MatchRecord play_one(const MatchSettings& settings, const Progress& progress);

/// The sums of a seat's payoffs in the first 1, 2, ... rounds.
std::vector<Rational> running_scores(const MatchSettings& settings, const MatchRecord& record, Seat seat);

/// The share of rounds in which the seat cooperated.
double cooperation_rate(const MatchRecord& record, Seat seat);

/// The move that the seat held likelier for the other to play; nothing in a round without a belief.
std::optional<Move> expected_move(const MatchRecord& record, Seat seat, std::size_t round);

/// The share of expected moves that the other really played, nothing for a player without beliefs.
std::optional<double> belief_accuracy(const MatchRecord& record, Seat seat);

}  // namespace folk::tools
