#pragma once
// The whole match so far, for strategies that look back without limit.

#include <folk/games/move.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace folk {

/// The moves of one side.
class Moves {
public:
  void add(Move move) {
    moves_.push_back(move);
    defections_ += bit(move);
  }
  std::size_t size() const { return moves_.size(); }
  std::size_t defections() const { return defections_; }
  std::size_t cooperations() const { return size() - defections_; }
  Move operator[](std::size_t round) const { return moves_[round]; }
  Move last() const { return moves_.back(); }
  /// The last move but one; C before there is one.
  Move last_but_one() const { return size() < 2 ? Move::C : moves_[size() - 2]; }
  /// How many C from round `from` (counted from 0) up to but without round `to`.
  std::size_t cooperations(std::size_t from, std::size_t to) const {
    const auto at = [&](std::size_t round) { return moves_.begin() + static_cast<std::ptrdiff_t>(round); };
    return static_cast<std::size_t>(std::count(at(from), at(to), Move::C));
  }

private:
  std::vector<Move> moves_;
  std::size_t defections_ = 0;
};

struct Record {
  Moves own;
  Moves theirs;

  void add(Move own_move, Move their_move) {
    own.add(own_move);
    theirs.add(their_move);
  }
  /// Rounds played.
  std::size_t rounds() const { return theirs.size(); }
};

}  // namespace folk
