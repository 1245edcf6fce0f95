#include <folk/mpe/players/player.h>

#include <iterator>
#include <utility>

namespace folk::mpe {

void Player::start(const Layout&, const Block&, std::size_t, const Moment&) {}

std::vector<std::size_t> agents_of(const Layout& layout, Side side) {
  std::vector<std::size_t> agents;
  for (std::size_t agent = 0; agent < layout.agents(); ++agent)
    if (side_of(layout, agent) == side) agents.push_back(agent);
  return agents;
}

MakeTeam each(std::function<std::unique_ptr<Player>(const Layout& layout, std::size_t agent)> player) {
  return [player = std::move(player)](const Layout& layout, Side side) {
    Team team;
    for (const std::size_t agent : agents_of(layout, side)) team.push_back(player(layout, agent));
    return team;
  };
}

std::unique_ptr<Player> Controller::player(const Layout& layout, std::size_t agent) const {
  const Side side = side_of(layout, agent);
  const auto agents = agents_of(layout, side);
  return std::move(team(layout, side).at(agent - agents.front()));
}

Team Cast::players(const Layout& layout) const {
  Team players = predators.team(layout, Side::predators);
  Team others = prey.team(layout, Side::prey);
  players.insert(players.end(), std::make_move_iterator(others.begin()), std::make_move_iterator(others.end()));
  return players;
}

}  // namespace folk::mpe
