#pragma once
// Whatever plays: told each round, asked for its next move, optionally for its belief.

#include <folk/games/criterion.h>
#include <folk/games/move.h>
#include <folk/games/payoffs.h>
#include <folk/games/random.h>

#include <memory>
#include <optional>
#include <span>

namespace folk {

/// What a player is told before a match.
struct MatchStart {
  Payoffs payoffs;
  Criterion criterion = Criterion::finite(100);
  RandomKey random;  ///< the key of this player's own random numbers in this match
};

/// An opaque player: it is played, never enumerated.
class Player {
public:
  virtual ~Player() = default;

  /// A new match begins; whatever was learnt in an earlier one is forgotten.
  virtual void start(const MatchStart& match) = 0;

  /// The move of the coming round. Called once a round.
  virtual Move move() = 0;

  /// What was really played in this round, after any noise.
  virtual void observe(Move own, Move theirs) = 0;

  /// No more matches follow. Throws EnvironmentError for what shows only now and makes what was played worthless: a
  /// program that has spoken unasked. A player that is not told so ends quietly.
  virtual void finish() {}

  /// P(the opponent plays C) in the round that `move` was last called for; nothing for a player without beliefs.
  virtual std::optional<double> belief() const { return std::nullopt; }

  /// A hint: `peers`, players of the same strategy and this one among them, are all about to be asked for their move in
  /// the same round of matches of their own (or of one match against each other). Who thinks expensively may now think
  /// for all of them at once, with up to `threads` threads. move() returns the same with or without it. Given only to
  /// strategies that say `thinks_together`.
  virtual void think_together(std::span<Player* const> peers, unsigned threads) {
    static_cast<void>(peers);
    static_cast<void>(threads);
  }

  /// A second player that stands in the same place of the same match and from here on moves and believes as this one
  /// would; null where there is no such thing (a program at the other end of a pipe): whoever wants one then tells a
  /// new player the match from its start.
  virtual std::unique_ptr<Player> clone() const { return nullptr; }

protected:
  Player() = default;
  Player(const Player&) = default;
  Player& operator=(const Player&) = default;
};

/// The move that a belief holds likelier; C at even odds.
constexpr Move likelier_move(double belief) { return belief >= 0.5 ? Move::C : Move::D; }

class Machine;

/// A machine as a player; it draws from the match's random key where its state mixes.
std::unique_ptr<Player> play(std::shared_ptr<const Machine> machine);

}  // namespace folk
