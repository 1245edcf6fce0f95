#pragma once
// Bayes-optimal play over T rounds against an opponent drawn from a known roster of deterministic machines.

#include <folk/games/move.h>
#include <folk/games/outcome.h>
#include <folk/games/payoffs.h>
#include <folk/strategies/strategy.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace folk {

/// The play of one who knows the roster, but not which of its members is met: the rational learner of Kalai & Lehrer
/// (Econometrica 61, 1993) whose prior holds a grain of truth.
///
/// An information state is a round and the members that would have played as was seen, each with its present state.
/// They form a tree of merging branches that is laid out round by round and solved backwards:
///   V(I) = max over own m of sum over members i in I of w_i u(m, x_i) + V(I after (m, C)) + V(I after (m, D)).
/// Members whose play is the same from here on count as one, their weights added: it changes no value and no belief.
///
/// Every own move is laid out, not only the best one: any play against a member of the roster can be followed. Sums are
/// whole numbers, and so ties are ties, when the prior is equal or given in whole numbers.
class BayesReply {
public:
  using Node = std::uint32_t;                  ///< an information state: a round and what is still consistent
  static constexpr Node nowhere = 0xFFFFFFFF;  ///< play that no member of the roster produces, or the end

  /// More information states are refused: they take 48 bytes each, and about twice that while they are laid out.
  static constexpr std::size_t most_nodes = 10'000'000;

  /// `prior`: one weight a member, not negative, in any unit (2, 1, 1 is twice the first); none: equal weights.
  /// Throws UsageError, naming the roster, when a member is no deterministic machine or has more than 2^17 states
  /// within T rounds, the prior does not fit, there are more than `most` information states, or totals pass 2^53 in
  /// units of the payoffs' last digit.
  BayesReply(const std::vector<Strategy>& roster, const Payoffs& payoffs, std::uint64_t rounds,
             std::vector<double> prior = {}, std::size_t most = most_nodes);

  /// Before the first round.
  Node root() const { return 0; }

  /// The expected total over the T rounds times the size of the roster: with an equal prior what optimal play earns in
  /// all against one opponent of each kind (5160 for sct2025 over 100 rounds).
  double value() const;

  // Each of the following takes a node that is not `nowhere`.

  /// P(the opponent plays C now), given the play so far.
  double belief(Node node) const { return nodes_[node].cooperating / nodes_[node].weight; }

  /// The expected total from here on when one's own move is C and when it is D, optimal play following; given the play
  /// so far.
  std::array<double, 2> action_values(Node node) const;

  /// The better move; C where both are as good.
  Move best(Node node) const { return nodes_[node].totals[1] > nodes_[node].totals[0] ? Move::D : Move::C; }

  /// What is known after both moves. `nowhere` after the last round, when no consistent member plays `theirs`, and from
  /// `nowhere`.
  Node next(Node node, Move own, Move theirs) const {
    return node == nowhere ? nowhere : nodes_[node].next[Outcome{own, theirs}.index()];
  }

  /// How many information states there are.
  std::size_t size() const { return nodes_.size(); }

private:
  struct Information {
    std::array<Node, 4> next{nowhere, nowhere, nowhere, nowhere};
    std::array<double, 2> totals{};  // of own C and D, the members' weights times whole payoffs
    double weight = 0;               // of the consistent members
    double cooperating = 0;          // of those that play C now
  };

  void solve(const std::array<double, 4>& payoffs);

  std::vector<Information> nodes_;
  double scale_ = 1;  // of totals: the payoffs' denominator
  std::size_t members_;
};

}  // namespace folk
