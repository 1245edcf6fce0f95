#pragma once
// What a policy learns from: one player's view of one match.

#include <folk/games/move.h>

#include <cstddef>
#include <string>
#include <vector>

namespace folk::sct {

/// One player's view of one match of a 2x2 game. The three vectors have the length of the match.
struct Trajectory {
  std::string player;
  std::string opponent;
  std::vector<Move> own;
  std::vector<Move> theirs;
  std::vector<double> rewards;  ///< payoff of each round to the player

  std::size_t rounds() const { return own.size(); }

  void add(Move own_move, Move their_move, double reward) {
    own.push_back(own_move);
    theirs.push_back(their_move);
    rewards.push_back(reward);
  }

  bool operator==(const Trajectory&) const = default;
};

}  // namespace folk::sct
