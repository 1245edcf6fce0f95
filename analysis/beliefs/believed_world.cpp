#include <folk/analysis/beliefs/believed_world.h>
#include <folk/games/outcome.h>

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace folk {

BelievedWorld::BelievedWorld(const Strategy& player, const Payoffs& payoffs, const Criterion& criterion,
                             unsigned threads)
    : strategy_(player),
      match_{payoffs, criterion, {}},
      threads_(threads),
      histories_(1) {
  auto first = new_player();
  if (first->clone() == nullptr) lone_player_ = std::move(first);
}

std::unique_ptr<Player> BelievedWorld::new_player() const {
  auto player = strategy_.new_player();
  player->start(match_);
  return player;
}

BelievedWorld::Node BelievedWorld::after(Node node, Move own, Move theirs) {
  const Outcome last{own, theirs};
  const std::size_t o = last.index();
  if (histories_[node].next[o] == none) {
    const Node child = static_cast<Node>(histories_.size());
    auto& history = histories_.emplace_back();
    history.parent = node;
    history.last = last;
    history.round = histories_[node].round + 1;
    histories_[node].next[o] = child;
  }
  return histories_[node].next[o];
}

void BelievedWorld::think(std::span<const Node> nodes) {
  if (clones()) {
    std::vector<Node> fresh;
    for (const Node node : nodes)
      if (!std::exchange(histories_[node].thought, true)) fresh.push_back(node);
    if (!fresh.empty()) think_in_company(fresh);
    return;
  }
  for (const Node node : nodes) {
    if (histories_[node].thought) continue;
    std::vector<Node> way;
    for (Node n = node; n != start; n = histories_[n].parent) way.push_back(n);
    lone_player_->start(match_);
    tell(*lone_player_, way, false);
    note(node, *lone_player_);
  }
}

void BelievedWorld::think_in_company(std::span<const Node> nodes) {
  // The last one that goes on from a node takes its player over.
  std::unordered_map<Node, std::size_t> last_heir;
  for (std::size_t i = 0; i < nodes.size(); ++i) last_heir[histories_[nodes[i]].parent] = i;
  std::vector<Player*> players;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    auto player = player_for(nodes[i], last_heir[histories_[nodes[i]].parent] == i);
    players.push_back(player.get());
    histories_[nodes[i]].player = std::move(player);
    seated_.push_back(nodes[i]);
  }
  if (strategy_.thinks_together) players.front()->think_together(players, threads_);
  for (std::size_t i = 0; i < nodes.size(); ++i) note(nodes[i], *players[i]);
}

std::unique_ptr<Player> BelievedWorld::player_for(Node node, bool take_over) {
  std::vector<Node> way;
  Node from = node;
  for (; from != start && !histories_[from].player; from = histories_[from].parent) way.push_back(from);
  History& standing = histories_[from];
  std::unique_ptr<Player> player;
  const bool moved = standing.player != nullptr;  // who stands somewhere has said its move there
  if (!moved)
    player = new_player();
  else if (take_over && !standing.kept && way.size() == 1)
    player = std::move(standing.player);
  else
    player = standing.player->clone();
  tell(*player, way, moved);
  return player;
}

void BelievedWorld::tell(Player& player, const std::vector<Node>& way, bool moved) {
  for (auto node = way.rbegin(); node != way.rend(); ++node) {
    if (!std::exchange(moved, false)) note(histories_[*node].parent, player);
    const auto [own, theirs] = histories_[*node].last;
    player.observe(own, theirs);
  }
}

void BelievedWorld::note(Node node, Player& player) {
  History& history = histories_[node];
  history.own = player.move();
  history.thought = true;
  ++thoughts_;
  const auto belief = player.belief();
  history.believes = belief.has_value();
  if (!belief) return;
  history.belief = *belief;
  history.believed = likelier_move(*belief);
}

std::optional<std::vector<std::vector<BelievedWorld::Node>>> BelievedWorld::walk(const std::vector<BeliefMatch>& paths,
                                                                                 const Progress& progress) {
  const std::size_t rounds = paths.front().size();
  std::vector<std::vector<Node>> nodes(paths.size(), std::vector<Node>(rounds, start));
  for (std::size_t i = 0; i < paths.size(); ++i)
    for (std::size_t t = 1; t < rounds; ++t)
      nodes[i][t] = after(nodes[i][t - 1], paths[i][t - 1].own, paths[i][t - 1].theirs);
  for (std::size_t k = 0; k < rounds; ++k) {
    // Who is told a whole match anew thinks about all of its rounds on the way to the last.
    const std::size_t t = clones() ? k : rounds - 1 - k;
    progress.check();
    std::vector<Node> now;
    for (const auto& path : nodes) now.push_back(path[t]);
    think(now);
    for (const Node node : now) {
      if (!believes(node)) return std::nullopt;
      keep(node);
    }
  }
  return nodes;
}

void BelievedWorld::keep(Node node) {
  History& history = histories_[node];
  if (!history.player) return;
  history.player = history.player->clone();  // without what only the last thought needed
  history.kept = true;
}

void BelievedWorld::dismiss() {
  dismiss(seated_);
  seated_.clear();
}

void BelievedWorld::dismiss(std::span<const Node> nodes) {
  for (const Node node : nodes)
    if (!histories_[node].kept) histories_[node].player.reset();
}

}  // namespace folk
