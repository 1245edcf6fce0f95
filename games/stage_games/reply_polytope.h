#pragma once
// The polytope {y >= 0, A y <= 1} of a matrix of positive numbers: what zero-sum and bimatrix games are solved on,
// exactly.

#include <folk/games/rational.h>
#include <folk/games/stage_game.h>

#include <cstddef>
#include <vector>

namespace folk {

/// Rows of numbers, all of one length.
using RationalMatrix = std::vector<std::vector<Rational>>;

/// The payoffs of `seat`, one row for each of its own actions, raised by `raise`.
RationalMatrix own_payoffs(const StageGame& game, Seat seat, const Rational& raise = 0);

/// By how much own_payoffs must be raised so that the least is 1.
Rational raise_to_positive(const StageGame& game, Seat seat);

/// The polytope at one of its bases, as the simplex method keeps it (Dantzig 1951). Variables are numbered: first the
/// coordinates of y, then the slack of each row of A. Ties are broken lexicographically (Dantzig, Orden & Wolfe 1955),
/// so that moving from basis to basis is moving along the edges of a simple polytope, and nothing goes round in
/// circles. At the start y = 0.
class ReplyPolytope {
public:
  /// `a`: at least one row and one column, all numbers positive.
  explicit ReplyPolytope(const RationalMatrix& a);

  /// Goes to a y with the largest sum.
  void maximise_sum();

  /// y here.
  std::vector<Rational> point() const;

  /// The dual solution, once the sum is largest: a weight for each row of A, with the same sum.
  std::vector<Rational> dual() const;

  /// All vertices, y = 0 among them, each once, in the order found. Throws std::length_error beyond `most` bases.
  std::vector<std::vector<Rational>> vertices(std::size_t most) const;

private:
  bool is_basic(std::size_t variable) const;
  /// The row whose variable becomes 0 first when the entering one grows.
  std::size_t leaving_row(std::size_t entering) const;
  bool leaves_before(std::size_t row, std::size_t other_row, std::size_t entering) const;
  void pivot(std::size_t row, std::size_t entering);

  std::size_t rows_;
  std::size_t columns_;
  // Whole numbers over one divisor, so that no fraction is ever reduced (Edmonds 1967, Bareiss 1968).
  Integer unit_ = 1;  // the common denominator of A
  Integer divisor_ = 1;
  std::vector<std::vector<Integer>> cells_;  // the last row is the objective's, the last column the right side
  std::vector<std::size_t> basic_;           // the variable of each row
};

}  // namespace folk
