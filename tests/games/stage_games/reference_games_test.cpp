#include <folk/games/payoffs.h>
#include <folk/games/stage_games/reference_games.h>

#include <algorithm>
#include <optional>
#include <set>

#include "games/expect_error.h"

namespace folk {
namespace {

using test::expect_error;

class ReferenceGames : public testing::TestWithParam<ReferenceGame> {};

INSTANTIATE_TEST_SUITE_P(All, ReferenceGames, testing::ValuesIn(reference_games()),
                         [](const auto& entry) { return entry.param.name; });

TEST_P(ReferenceGames, EquilibriaHaveNoProfitableDeviation) {
  EXPECT_FALSE(GetParam().equilibria.empty());
  for (const MixedProfile& profile : GetParam().equilibria) EXPECT_TRUE(is_equilibrium(GetParam().game, profile));
}

TEST_P(ReferenceGames, PureMinmax) {
  for (const Seat seat : both_seats) EXPECT_EQ(pure_minmax(GetParam().game, seat), GetParam().minmax_of(seat).pure);
}

// The punishment proves that the value is no larger, the security that it is no smaller.
TEST_P(ReferenceGames, MixedMinmax) {
  const StageGame& game = GetParam().game;
  for (const Seat seat : both_seats) {
    const Minmax& minmax = GetParam().minmax_of(seat);
    const auto replies = action_payoffs(game, seat, minmax.punishment);
    EXPECT_EQ(*std::max_element(replies.begin(), replies.end()), minmax.mixed);
    const std::size_t opponents = game.actions(other(seat)).size();
    std::optional<Rational> least;
    for (std::size_t theirs = 0; theirs < opponents; ++theirs) {
      const MixedAction pure = pure_action(opponents, theirs);
      const Rational value = seat == Seat::first ? expected_payoff(game, seat, {minmax.security, pure})
                                                 : expected_payoff(game, seat, {pure, minmax.security});
      if (!least || value < *least) least = value;
    }
    EXPECT_EQ(least, minmax.mixed);
    EXPECT_LE(minmax.mixed, minmax.pure);
  }
}

using Matrix = std::vector<std::vector<Rational>>;

/// The one solution of a square linear system (its last column is the right side), or nothing when singular.
std::optional<std::vector<Rational>> solve(Matrix m) {
  const std::size_t n = m.size();
  for (std::size_t column = 0; column < n; ++column) {
    std::size_t pivot = column;
    while (pivot < n && m[pivot][column] == 0) ++pivot;
    if (pivot == n) return std::nullopt;
    std::swap(m[pivot], m[column]);
    for (std::size_t row = 0; row < n; ++row) {
      if (row == column) continue;
      const Rational factor = m[row][column] / m[column][column];
      for (std::size_t k = column; k <= n; ++k) m[row][k] -= factor * m[column][k];
    }
  }
  std::vector<Rational> solution(n);
  for (std::size_t i = 0; i < n; ++i) solution[i] = m[i][n] / m[i][i];
  return solution;
}

/// The mixture of the other seat over `theirs` that makes `seat` indifferent among `own` (as many), if it is the only
/// one and all its weights are positive.
std::optional<MixedAction> indifference(const StageGame& game, Seat seat, const std::vector<std::size_t>& own,
                                        const std::vector<std::size_t>& theirs) {
  const std::size_t n = own.size();
  const auto payoff = [&](std::size_t i, std::size_t j) {
    return seat == Seat::first ? game.payoff(seat, i, j) : game.payoff(seat, j, i);
  };
  // Unknowns: the n weights and the common payoff.
  Matrix m(n + 1, std::vector<Rational>(n + 2));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) m[i][j] = payoff(own[i], theirs[j]);
    m[i][n] = -1;
    m[n][i] = 1;
  }
  m[n][n + 1] = 1;
  const auto weights = solve(m);
  if (!weights) return std::nullopt;
  MixedAction mix(game.actions(other(seat)).size());
  for (std::size_t j = 0; j < n; ++j) {
    if ((*weights)[j] <= 0) return std::nullopt;
    mix[theirs[j]] = (*weights)[j];
  }
  return mix;
}

std::vector<std::vector<std::size_t>> supports(std::size_t actions) {
  std::vector<std::vector<std::size_t>> all;
  for (std::size_t set = 1; set < (std::size_t{1} << actions); ++set) {
    all.emplace_back();
    for (std::size_t i = 0; i < actions; ++i)
      if ((set >> i & 1U) != 0) all.back().push_back(i);
  }
  return all;
}

// In a nondegenerate game both seats of an equilibrium mix over equally many actions (von Stengel 2007, chapter 3), so
// that trying all pairs of supports finds every equilibrium.
TEST_P(ReferenceGames, ThereIsNoOtherEquilibrium) {
  const StageGame& game = GetParam().game;
  const auto& known = GetParam().equilibria;
  std::size_t found = 0;
  for (const auto& rows : supports(game.rows()))
    for (const auto& columns : supports(game.columns())) {
      if (rows.size() != columns.size()) continue;
      const auto row = indifference(game, Seat::second, columns, rows);
      const auto column = indifference(game, Seat::first, rows, columns);
      if (!row || !column || !is_equilibrium(game, {*row, *column})) continue;
      ++found;
      EXPECT_NE(std::find(known.begin(), known.end(), MixedProfile{*row, *column}), known.end());
    }
  EXPECT_EQ(found, known.size());
  EXPECT_EQ(found % 2, 1U);  // Wilson (1971): a nondegenerate game has an odd number
}

TEST_P(ReferenceGames, IsFoundByItsName) {
  EXPECT_EQ(&reference_game(GetParam().name), &reference_game(GetParam().name));
}

TEST(ReferenceGameNames, AreUniqueAndUnknownOnesAreRefused) {
  std::set<std::string> names;
  for (const ReferenceGame& entry : reference_games()) names.insert(entry.name);
  EXPECT_EQ(names.size(), reference_games().size());
  expect_error<UsageError>([] { reference_game("stag"); },
                           "there is no reference game 'stag': take one of prisoners_dilemma, stag_hunt, chicken, "
                           "battle_of_the_sexes, matching_pennies, harmony, deadlock, abreu_sannikov");
}

TEST(ReferenceGameKinds, OrderOfPayoffs) {
  const auto letters = [](const char* name) { return symmetric_payoffs(reference_game(name).game); };
  const auto pd = letters("prisoners_dilemma");
  EXPECT_TRUE(pd.temptation > pd.reward && pd.reward > pd.punishment && pd.punishment > pd.sucker);
  EXPECT_EQ(pd, Payoffs{});
  const auto stag = letters("stag_hunt");
  EXPECT_TRUE(stag.reward > stag.temptation && stag.temptation >= stag.punishment && stag.punishment > stag.sucker);
  const auto chicken = letters("chicken");
  EXPECT_TRUE(chicken.temptation > chicken.reward && chicken.reward > chicken.sucker &&
              chicken.sucker > chicken.punishment);
  const auto harmony = letters("harmony");
  EXPECT_TRUE(harmony.reward > harmony.temptation && harmony.temptation > harmony.sucker &&
              harmony.sucker > harmony.punishment);
  const auto deadlock = letters("deadlock");
  EXPECT_TRUE(deadlock.temptation > deadlock.punishment && deadlock.punishment > deadlock.reward &&
              deadlock.reward > deadlock.sucker);
}

}  // namespace
}  // namespace folk
