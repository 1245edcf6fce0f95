#include <folk/analysis/folk_theorem/equilibrium_iteration.h>
#include <folk/analysis/folk_theorem/equilibrium_set.h>
#include <folk/analysis/folk_theorem/payoff_region.h>
#include <folk/games/criterion.h>
#include <folk/games/error.h>

#include <fmt/format.h>

#include <cmath>
#include <optional>

namespace folk {
namespace {

/// Payoffs of one seat in units of a power of two, from its least on.
struct Unit {
  Rational least;
  Rational size;

  Precise of(const Rational& payoff) const { return precise((payoff - least) / size); }
  double back(const Precise& value) const {
    const Precise payoff = precise(least) + precise(size) * value;
    return abs(payoff) <= precise(size) * rounding() ? 0 : payoff.convert_to<double>();
  }
};

/// How small a part of the unit the payoffs of a seat may be multiples of: finer ones would get lost in rounding.
const Rational& finest_payoffs() {
  static const Rational value(1, pow(2, 200));
  return value;
}

Unit unit_of(const StageGame& game, Seat seat) {
  const std::size_t axis = index(seat);
  const auto pairs = payoff_pairs(game);
  const auto [least, most] =
      std::minmax_element(pairs.begin(), pairs.end(), [&](const auto& a, const auto& b) { return a[axis] < b[axis]; });
  const Rational range = (*most)[axis] - (*least)[axis];
  if (range == 0) return {(*least)[axis], 1};
  if (!std::isfinite(to_double(range)) || !std::isfinite(to_double((*least)[axis])))
    throw UsageError("payoffs beyond 1e308 are too large for an equilibrium set: measure them in a larger unit");
  Rational size = 1;
  while (size < range) size *= 2;
  while (size / 2 >= range) size /= 2;
  Integer parts = 1;
  for (const auto& pair : pairs) parts = lcm(parts, denominator((pair[axis] - (*least)[axis]) / size));
  if (Rational(1, parts) < finest_payoffs())
    throw UndecidedError(
        "the payoffs of one player differ by too much and too little at once for an equilibrium set: measured in the "
        "largest difference, the payoffs must have a common denominator up to 2^200");
  return {(*least)[axis], size};
}

/// Every profile with what deviating from it pays.
std::vector<RepeatedProfile> profiles_of(const StageGame& game, const std::array<Unit, 2>& units) {
  std::vector<Rational> best_in_column(game.columns());
  std::vector<Rational> best_in_row(game.rows());
  for (std::size_t i = 0; i < game.rows(); ++i)
    for (std::size_t j = 0; j < game.columns(); ++j) {
      const Rational& row = game.payoff(Seat::first, i, j);
      const Rational& column = game.payoff(Seat::second, i, j);
      if (i == 0 || row > best_in_column[j]) best_in_column[j] = row;
      if (j == 0 || column > best_in_row[i]) best_in_row[i] = column;
    }
  std::vector<RepeatedProfile> profiles;
  for (std::size_t i = 0; i < game.rows(); ++i)
    for (std::size_t j = 0; j < game.columns(); ++j)
      profiles.push_back({{units[0].of(game.payoff(Seat::first, i, j)), units[1].of(game.payoff(Seat::second, i, j))},
                          {units[0].of(best_in_column[j]), units[1].of(best_in_row[i])}});
  return profiles;
}

/// The least difference between two payoffs of one seat, in its unit; 1 where all are equal.
Precise least_difference(const std::vector<RepeatedProfile>& profiles) {
  Precise least = 1;
  for (const std::size_t axis : {0U, 1U}) {
    std::vector<Precise> payoffs;
    for (const RepeatedProfile& profile : profiles) payoffs.push_back(profile.payoff[axis]);
    std::sort(payoffs.begin(), payoffs.end());
    for (std::size_t i = 1; i < payoffs.size(); ++i)
      if (payoffs[i] != payoffs[i - 1]) least = std::min(least, Precise(payoffs[i] - payoffs[i - 1]));
  }
  return least;
}

/// The fraction of the least denominator that is at most `discount_tolerance` of d or 1-d, whichever is less, above d.
Rational meant(const Rational& discount) {
  const Rational room = std::min(discount, 1 - discount) * discount_tolerance();
  return simplest_between(discount, discount + room);
}

/// How many steps there are to each shortcut, which takes as long as some of them: the more, the more profiles.
std::size_t pause_of(std::size_t steps, std::size_t profiles) {
  return std::max<std::size_t>(steps < 1'000 ? 10 : 2, profiles / 8);
}

}  // namespace

const Rational& discount_tolerance() {
  static const Rational value(1, pow(10, 13));
  return value;
}

EquilibriumSet pure_equilibrium_set(const StageGame& game, const Rational& discount, std::size_t most_steps) {
  require_small_for_region(game);
  EquilibriumSet result;
  result.discount = Criterion::discounted(discount).continuation();
  const std::array<Unit, 2> units{unit_of(game, Seat::first), unit_of(game, Seat::second)};
  const Point<Precise> minmax{units[0].of(pure_minmax(game, Seat::first)),
                              units[1].of(pure_minmax(game, Seat::second))};
  auto profiles = profiles_of(game, units);
  // Where payoffs differ by parts of a thousandth, what counts as no difference must be smaller, too.
  const Precise scale = std::min(Precise(1), Precise(1000 * least_difference(profiles)));
  const Rational simplest = meant(discount);
  const Precise enough = Precise(1e-12) * precise(1 - simplest) * scale;
  EquilibriumIteration iteration(std::move(profiles), minmax, simplest);
  for (Precise change = 1; change > enough;) {
    if (result.steps >= most_steps)
      throw UndecidedError(fmt::format(
          "discount factor {}: the set still moves by {:.2g} of the payoffs' range after {} steps: take one farther "
          "from 1",
          to_text(discount), result.change, result.steps));
    if (result.steps >= plain_steps && result.steps % pause_of(result.steps, game.rows() * game.columns()) == 0)
      iteration.tighten();
    change = iteration.step();
    ++result.steps;
    result.change = change.convert_to<double>();
  }
  // What the last steps had not yet taken away must not show as payoffs below what a player can secure.
  const auto set = clipped(clipped(iteration.set(), 0, minmax[0]), 1, minmax[1]);
  if (set.empty()) return result;
  const auto least = lowest(set);
  result.worst = {units[0].back(least[0]), units[1].back(least[1])};
  for (const auto& corner : without_blunt_corners(set, Precise(1e-10) * scale))
    result.corners.push_back({units[0].back(corner[0]), units[1].back(corner[1])});
  return result;
}

EquilibriumSet pure_equilibrium_set(const StageGame& game, double discount, std::size_t most_steps) {
  return pure_equilibrium_set(game, Criterion::discounted(discount).exact_continuation(), most_steps);
}

}  // namespace folk
