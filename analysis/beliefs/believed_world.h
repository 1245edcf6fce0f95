#pragma once
// The world as a player holds it: histories, and after each of them what the player believes and would do.

#include <folk/analysis/beliefs/belief_record.h>
#include <folk/games/criterion.h>
#include <folk/games/outcome.h>
#include <folk/games/payoffs.h>
#include <folk/games/progress.h>
#include <folk/strategies/strategy.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace folk {

/// A tree of histories of matches of one deterministic player, laid out as far as somebody asks. Equal histories are
/// one node, whatever opponent they were met with, and are thought about once.
///
/// Players stand in the nodes that were thought about last, so that going on costs one thought a round; from elsewhere
/// the way from the nearest player that still stands is thought through again. A player without Player::clone is told
/// each history from its start.
class BelievedWorld {
public:
  using Node = std::uint32_t;
  static constexpr Node start = 0;

  /// `player` must outlive this. Throws what its players throw at the start of a match.
  BelievedWorld(const Strategy& player, const Payoffs& payoffs, const Criterion& criterion, unsigned threads);

  /// False for a player that is told each history from its start: it thinks about all shorter ones on the way.
  bool clones() const { return lone_player_ == nullptr; }

  /// The history one round longer.
  Node after(Node node, Move own, Move theirs);

  /// Rounds that have been played.
  std::uint64_t round(Node node) const { return histories_[node].round; }

  /// Thinks about all of these at once (Player::think_together); a node is thought about only once.
  void think(std::span<const Node> nodes);

  // Of a node that was thought about.
  bool believes(Node node) const { return histories_[node].believes; }
  Move believed(Node node) const { return histories_[node].believed; }  ///< the move that is held likelier
  double belief(Node node) const { return histories_[node].belief; }    ///< P(the opponent plays C)
  Move own(Node node) const { return histories_[node].own; }

  /// What the player expects to come next when it moves `own`.
  Node after(Node node, Move own) { return after(node, own, believed(node)); }

  /// Thinks about the histories before each round of paths of one length, keeps a player in each, and returns their
  /// nodes [paths][rounds]; nothing when the player holds no belief in one of them. Throws Cancelled.
  std::optional<std::vector<std::vector<Node>>> walk(const std::vector<BeliefMatch>& paths, const Progress& progress);

  /// A player stays in this node, which was thought about last, until the end.
  void keep(Node node);

  /// All players leave but those that are kept; or only those in these nodes.
  void dismiss();
  void dismiss(std::span<const Node> nodes);

  /// Nothing more will be asked. Throws what Player::finish does.
  void finish() {
    if (lone_player_) lone_player_->finish();
  }

  /// How often a player was asked for a move so far.
  std::uint64_t thoughts() const { return thoughts_; }

private:
  static constexpr Node none = 0xFFFFFFFF;

  struct History {
    Node parent = none;
    Outcome last;  // of the last round
    bool thought = false;
    bool believes = false;
    bool kept = false;
    Move believed = Move::C;
    Move own = Move::C;
    std::uint32_t round = 0;
    double belief = 0.5;
    std::array<Node, 4> next{none, none, none, none};
    std::unique_ptr<Player> player;  // has been told this history
  };

  std::unique_ptr<Player> new_player() const;
  std::unique_ptr<Player> player_for(Node node, bool take_over);
  void tell(Player& player, const std::vector<Node>& way, bool moved);
  void note(Node node, Player& player);
  void think_in_company(std::span<const Node> nodes);

  const Strategy& strategy_;
  MatchStart match_;
  unsigned threads_;
  std::vector<History> histories_;
  std::vector<Node> seated_;             // where players stand that are not kept
  std::unique_ptr<Player> lone_player_;  // of a strategy without clones
  std::uint64_t thoughts_ = 0;
};

}  // namespace folk
