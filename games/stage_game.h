#pragma once
// A finite two-player game in strategic form: what is played in each round of a repeated game.

#include <folk/games/rational.h>
#include <folk/games/seat.h>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace folk {

/// Any finite two-player game with named actions and exact payoffs.
class StageGame {
public:
  /// `payoffs[i * columns + j]` holds {row's, column's} payoff at row action i and column action j.
  /// Throws UsageError when a seat has no action, an action's name is empty or given twice, or the table's size is
  /// wrong.
  StageGame(std::string title, std::array<std::string, 2> players, std::array<std::vector<std::string>, 2> actions,
            std::vector<std::array<Rational, 2>> payoffs, std::string comment = {});

  const std::string& title() const { return title_; }
  /// What its author says of it; .nfg files carry it.
  const std::string& comment() const { return comment_; }
  const std::array<std::string, 2>& players() const { return players_; }
  const std::vector<std::string>& actions(Seat seat) const { return actions_[index(seat)]; }
  std::size_t rows() const { return actions_[0].size(); }
  std::size_t columns() const { return actions_[1].size(); }

  const Rational& payoff(Seat seat, std::size_t row, std::size_t column) const {
    return payoffs_[row * columns() + column][index(seat)];
  }

  /// True when both seats have the same number of actions and payoff(row, i, j) = payoff(column, j, i) throughout.
  bool is_symmetric() const;

  /// Same actions and payoffs; titles, players' names and comments are not compared.
  bool same_game(const StageGame& other) const;

private:
  std::string title_;
  std::array<std::string, 2> players_;
  std::array<std::vector<std::string>, 2> actions_;
  std::vector<std::array<Rational, 2>> payoffs_;
  std::string comment_;
};

}  // namespace folk
