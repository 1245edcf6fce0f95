#pragma once
// Small Moore machines out of observed play: a prefix tree of the opponent's moves whose states are merged.

#include <folk/games/move.h>
#include <folk/strategies/automaton.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace folk {

/// What a deterministic player was seen to move after each sequence of its opponent's moves. Its own moves are its own,
/// so that the opponent's are all of the history.
class PrefixTree {
public:
  static constexpr std::uint32_t none = 0xFFFFFFFF;  ///< a move that was never seen

  struct Node {
    std::array<double, 2> seen{};                   ///< weight of the C and of the D that was seen here
    std::array<std::uint32_t, 2> next{none, none};  ///< after the opponent's C and D
  };

  PrefixTree()
      : nodes_(1) {}

  /// A match: own[t] was moved after theirs[0..t). Every round weighs `weight`. Throws std::logic_error when there are
  /// fewer of their moves than own.size() - 1.
  void add(std::span<const Move> own, std::span<const Move> theirs, double weight = 1);

  /// One more round: what was moved after the history of `node`.
  void see(std::uint32_t node, Move own, double weight = 1) { nodes_[node].seen[bit(own)] += weight; }

  /// The history one move of the opponent longer.
  std::uint32_t after(std::uint32_t node, Move theirs);

  const std::vector<Node>& nodes() const { return nodes_; }

private:
  std::vector<Node> nodes_;
};

/// A machine out of a prefix tree.
struct MergedMachine {
  Automaton machine;             ///< minimal in the sense own_moves_its_own, next states by their move alone
  double weight = 0;             ///< of all moves in the tree
  double wrong = 0;              ///< of those that the machine moves otherwise
  std::size_t unseen_moves = 0;  ///< successors that nothing in the tree tells of: there the state stays as it is
};

/// Red-blue state merging (Lang, Pearlmutter & Price 1998, for Moore machines, with a price for states): red nodes are
/// states, blue ones their successors that are none yet. Folding a blue node and all that follows it into a red one
/// makes some moves wrong: those that are the lighter ones of the two moves seen in a state. A blue node that no red
/// one takes in for at most `state_price` moves becomes red, shallow ones first; when there is none, the fold that most
/// moves speak for is made, its wrong moves counting against it. So a state is made where it saves more than its
/// price; with price 0 the machine moves exactly as was seen. Ties go to the earlier state: the same tree gives the
/// same machine.
MergedMachine merge_states(const PrefixTree& tree, double state_price);

}  // namespace folk
