#include <folk/games/stage_games/reply_polytope.h>

#include <algorithm>
#include <deque>
#include <set>
#include <stdexcept>

namespace folk {

RationalMatrix own_payoffs(const StageGame& game, Seat seat, const Rational& raise) {
  RationalMatrix payoffs(game.actions(seat).size(), std::vector<Rational>(game.actions(other(seat)).size()));
  for (std::size_t own = 0; own < payoffs.size(); ++own)
    for (std::size_t theirs = 0; theirs < payoffs[own].size(); ++theirs)
      payoffs[own][theirs] =
          raise + (seat == Seat::first ? game.payoff(seat, own, theirs) : game.payoff(seat, theirs, own));
  return payoffs;
}

Rational raise_to_positive(const StageGame& game, Seat seat) {
  const RationalMatrix payoffs = own_payoffs(game, seat);
  Rational least = payoffs[0][0];
  for (const auto& row : payoffs) least = std::min(least, *std::min_element(row.begin(), row.end()));
  return 1 - least;
}

ReplyPolytope::ReplyPolytope(const RationalMatrix& a)
    : rows_(a.size()),
      columns_(a[0].size()),
      cells_(rows_ + 1, std::vector<Integer>(columns_ + rows_ + 1)),
      basic_(rows_) {
  for (const auto& row : a)
    for (const Rational& number : row) unit_ = lcm(unit_, denominator(number));
  for (std::size_t i = 0; i < rows_; ++i) {
    for (std::size_t j = 0; j < columns_; ++j) cells_[i][j] = numerator(a[i][j] * unit_);
    cells_[i][columns_ + i] = 1;
    cells_[i].back() = unit_;
    basic_[i] = columns_ + i;
  }
  std::fill_n(cells_[rows_].begin(), columns_, -1);
}

void ReplyPolytope::maximise_sum() {
  for (;;) {
    const auto& gains = cells_[rows_];
    const auto helps = std::min_element(gains.begin(), gains.end() - 1);  // Dantzig: what gains most
    if (*helps >= 0) return;
    const auto entering = static_cast<std::size_t>(helps - gains.begin());
    pivot(leaving_row(entering), entering);
  }
}

std::vector<Rational> ReplyPolytope::point() const {
  std::vector<Rational> y(columns_);
  for (std::size_t i = 0; i < rows_; ++i)
    if (basic_[i] < columns_) y[basic_[i]] = Rational(cells_[i].back(), divisor_);
  return y;
}

std::vector<Rational> ReplyPolytope::dual() const {
  std::vector<Rational> weights(rows_);
  for (std::size_t i = 0; i < rows_; ++i) weights[i] = Rational(cells_[rows_][columns_ + i] * unit_, divisor_);
  return weights;
}

std::vector<std::vector<Rational>> ReplyPolytope::vertices(std::size_t most) const {
  const auto basis_of = [](const ReplyPolytope& at) {
    return std::set<std::size_t>(at.basic_.begin(), at.basic_.end());
  };
  std::set<std::set<std::size_t>> bases{basis_of(*this)};
  std::set<std::vector<Rational>> known;
  std::vector<std::vector<Rational>> found;
  std::deque<ReplyPolytope> open{*this};
  for (; !open.empty(); open.pop_front()) {
    const ReplyPolytope& here = open.front();
    if (auto y = here.point(); known.insert(y).second) found.push_back(std::move(y));
    for (std::size_t entering = 0; entering < columns_ + rows_; ++entering) {
      if (here.is_basic(entering)) continue;
      const std::size_t row = here.leaving_row(entering);
      auto basis = basis_of(here);
      basis.erase(here.basic_[row]);
      basis.insert(entering);
      if (!bases.insert(std::move(basis)).second) continue;
      if (bases.size() > most) throw std::length_error("a polytope has too many bases");
      open.push_back(here);
      open.back().pivot(row, entering);
    }
  }
  return found;
}

bool ReplyPolytope::is_basic(std::size_t variable) const {
  return std::find(basic_.begin(), basic_.end(), variable) != basic_.end();
}

bool ReplyPolytope::leaves_before(std::size_t row, std::size_t other_row, std::size_t entering) const {
  const Integer& a = cells_[row][entering];
  const Integer& b = cells_[other_row][entering];
  // The right side, then the slacks, which stand for its ever smaller perturbations.
  for (std::size_t k = 0; k <= rows_; ++k) {
    const std::size_t column = k == 0 ? columns_ + rows_ : columns_ + k - 1;
    const Integer mine = cells_[row][column] * b;
    const Integer theirs = cells_[other_row][column] * a;
    if (mine != theirs) return mine < theirs;
  }
  return false;
}

std::size_t ReplyPolytope::leaving_row(std::size_t entering) const {
  std::size_t best = rows_;
  for (std::size_t i = 0; i < rows_; ++i)
    if (cells_[i][entering] > 0 && (best == rows_ || leaves_before(i, best, entering))) best = i;
  if (best == rows_) throw std::logic_error("a polytope of positive numbers is not bounded");
  return best;
}

void ReplyPolytope::pivot(std::size_t row, std::size_t entering) {
  const Integer next_divisor = cells_[row][entering];
  for (std::size_t i = 0; i <= rows_; ++i) {
    if (i == row) continue;
    const Integer factor = cells_[i][entering];
    for (std::size_t j = 0; j < cells_[i].size(); ++j) {
      Integer& cell = cells_[i][j];
      cell *= next_divisor;
      if (factor != 0 && cells_[row][j] != 0) cell -= factor * cells_[row][j];
      cell /= divisor_;  // without remainder
    }
  }
  divisor_ = next_divisor;
  basic_[row] = entering;
}

}  // namespace folk
