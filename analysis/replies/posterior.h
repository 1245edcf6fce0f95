#pragma once
// What a play reveals about which machine of a roster is met, and looking ahead a few rounds on it.

#include <folk/games/move.h>
#include <folk/strategies/machine.h>
#include <folk/strategies/strategy.h>

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

namespace folk {

/// Bayes' rule over a roster of machines, which may mix and count: each starts with the same weight, and every round
/// multiplies it by the probability of the move that was seen.
class Posterior {
public:
  /// Throws UsageError on an empty roster and on an opaque player.
  explicit Posterior(const std::vector<Strategy>& roster);

  /// A new match: every member is as likely, at its start.
  void reset();

  /// False when no member of the roster would have played so.
  bool possible() const { return !members_.empty(); }

  /// P(the opponent plays C now); it must be possible().
  double cooperation() const;

  /// What was really played.
  void observe(Move own, Move theirs);

  /// The expected payoff of the next `depth` rounds when one's own move is C and when it is D, the rest being played
  /// best; a round weighs `continuation` times the one before. Takes up to 4^depth steps for each member (2^depth for
  /// one that does not mix).
  std::array<double, 2> action_values(const std::array<double, 4>& payoffs, unsigned depth, double continuation) const;

private:
  struct Member {
    const Machine* machine;
    State state;
    double weight;
  };
  using Members = std::vector<Member>;

  /// As action_values, the weights not being divided by their sum; `rooms[0]` is where the next round's members go.
  static std::array<double, 2> totals(const Members& members, const std::array<double, 4>& payoffs, unsigned depth,
                                      double continuation, Members* rooms);

  /// Those that play `theirs` now, with their weights and states after the round.
  static void consistent(const Members& members, Move own, Move theirs, Members& left);

  std::vector<std::shared_ptr<const Machine>> roster_;
  Members members_;
};

}  // namespace folk
