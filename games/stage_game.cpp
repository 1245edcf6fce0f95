#include <folk/games/error.h>
#include <folk/games/stage_game.h>

#include <string_view>
#include <unordered_set>
#include <utility>

namespace folk {

StageGame::StageGame(std::string title, std::array<std::string, 2> players,
                     std::array<std::vector<std::string>, 2> actions, std::vector<std::array<Rational, 2>> payoffs,
                     std::string comment)
    : title_(std::move(title)),
      players_(std::move(players)),
      actions_(std::move(actions)),
      payoffs_(std::move(payoffs)),
      comment_(std::move(comment)) {
  for (const auto& names : actions_) {
    if (names.empty()) throw UsageError("a stage game needs at least one action for each player");
    std::unordered_set<std::string_view> seen;
    for (const auto& name : names) {
      if (name.empty()) throw UsageError("an action of a stage game has an empty name");
      if (!seen.insert(name).second) throw UsageError("action '" + excerpt(name) + "' of a stage game is given twice");
    }
  }
  if (payoffs_.size() != rows() * columns())
    throw UsageError("a " + std::to_string(rows()) + "x" + std::to_string(columns()) + " game needs " +
                     std::to_string(rows() * columns()) + " payoff pairs, not " + std::to_string(payoffs_.size()));
}

bool StageGame::is_symmetric() const {
  if (rows() != columns()) return false;
  for (std::size_t i = 0; i < rows(); ++i)
    for (std::size_t j = 0; j < columns(); ++j)
      if (payoff(Seat::first, i, j) != payoff(Seat::second, j, i)) return false;
  return true;
}

bool StageGame::same_game(const StageGame& other) const {
  return actions_ == other.actions_ && payoffs_ == other.payoffs_;
}

}  // namespace folk
