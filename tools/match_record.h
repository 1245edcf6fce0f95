#pragma once
// One match with everything that happened in it, and what follows from the moves.

#include "game_option.h"

#include <folk/games/transcript.h>

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace folk::tools {

/// What is played, with every default filled in.
struct MatchSettings {
  std::array<std::string, 2> players;
  ChosenGame game;
  std::uint64_t rounds = 30;
  double noise = 0;
  std::uint64_t seed = 1;
};

/// All that happened. `beliefs` is empty for a player that never told one, NaN in a round where it told none.
struct MatchRecord {
  std::array<std::string, 2> names;
  Transcript transcript;
  std::array<std::vector<bool>, 2> slipped;
  std::array<std::vector<double>, 2> beliefs;

  Move move(int seat, std::size_t round) const {
    return seat == 0 ? transcript.first(round) : transcript.second(round);
  }
};

/// Plays the match; tells `progress` the share of rounds that are done. Throws UsageError on an unknown strategy and
/// what the players throw.
MatchRecord play_one(const MatchSettings& settings, const std::function<void(double)>& progress);

/// The sums of a seat's payoffs in the first 1, 2, ... rounds.
std::vector<Rational> running_scores(const MatchSettings& settings, const MatchRecord& record, int seat);

/// The share of rounds in which the seat cooperated.
double cooperation_rate(const MatchRecord& record, int seat);

/// How well a belief foretold what the other really played: 1 right, 0 wrong, 1/2 for even odds, nothing without one.
std::optional<double> rightness(const MatchRecord& record, int seat, std::size_t round);

/// The mean of rightness over the rounds with a belief, nothing for a player without.
std::optional<double> belief_accuracy(const MatchRecord& record, int seat);

}  // namespace folk::tools
