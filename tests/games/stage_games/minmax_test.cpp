#include <folk/games/stage_games/minmax.h>
#include <folk/games/stage_games/reference_games.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "games/arbitrary.h"
#include "games/expect_error.h"

namespace folk {
namespace {

using test::expect_error;

/// The two mixtures prove the value: neither more nor less can be had.
bool proved(const StageGame& game, Seat seat, const Minmax& found) {
  return most_against(game, seat, found.punishment) == found.mixed &&
         guaranteed(game, seat, found.security) == found.mixed && found.pure == pure_minmax(game, seat) &&
         found.mixed <= found.pure;
}

TEST(Minmax, OfTheReferenceGames) {
  for (const ReferenceGame& entry : reference_games())
    for (const Seat seat : both_seats) {
      const Minmax found = minmax(entry.game, seat);
      EXPECT_EQ(found.pure, entry.minmax_of(seat).pure) << entry.name;
      EXPECT_EQ(found.mixed, entry.minmax_of(seat).mixed) << entry.name;
      EXPECT_TRUE(proved(entry.game, seat, found)) << entry.name;
    }
}

// Rock, paper, scissors and a fourth action that always pays the row player less than its value.
TEST(Minmax, MixesOverWhatHelps) {
  const StageGame game(
      "RPS", {"Row", "Column"}, {{{"R", "P", "S", "none"}, {"R", "P", "S"}}},
      {{0, 0}, {-1, 1}, {1, -1}, {1, -1}, {0, 0}, {-1, 1}, {-1, 1}, {1, -1}, {0, 0}, {-2, 0}, {-2, 0}, {-2, 0}});
  const Minmax found = minmax(game, Seat::first);
  EXPECT_EQ(found.pure, 1);
  EXPECT_EQ(found.mixed, 0);
  EXPECT_EQ(found.punishment, (MixedAction{{1, 3}, {1, 3}, {1, 3}}));
  EXPECT_EQ(found.security, (MixedAction{{1, 3}, {1, 3}, {1, 3}, 0}));
}

// In the stag hunt mixing punishes as hard as Hare does, no harder.
TEST(Minmax, IsPureWhereThatServes) {
  const Minmax found = minmax(reference_game("stag_hunt").game, Seat::first);
  EXPECT_EQ(found.punishment, pure_action(2, 1));
  EXPECT_EQ(found.security, pure_action(2, 1));
}

TEST(Minmax, RefusesWhatIsNoMixture) {
  const StageGame& game = reference_game("chicken").game;
  expect_error<UsageError>([&] { most_against(game, Seat::first, {1}); }, "1 probabilities for 2 actions");
  expect_error<UsageError>([&] { guaranteed(game, Seat::second, {1, 1}); }, "add up to 2");
}

RC_GTEST_PROP(Minmax, PunishmentAndSecurityMeet, (const StageGame& game)) {
  for (const Seat seat : both_seats) RC_ASSERT(proved(game, seat, minmax(game, seat)));
}

// Small whole payoffs have many equal ones, where a pivot rule could go round in circles.
RC_GTEST_PROP(Minmax, EndsInDegenerateGames, ()) {
  const auto rows = *rc::gen::inRange<std::size_t>(1, 9);
  const auto columns = *rc::gen::inRange<std::size_t>(1, 9);
  const auto most = *rc::gen::inRange(1, 4);
  const auto names = [](std::size_t actions) {
    std::vector<std::string> all;
    for (std::size_t i = 0; i < actions; ++i) all.push_back(std::to_string(i));
    return all;
  };
  std::vector<std::array<Rational, 2>> payoffs(rows * columns);
  for (auto& pair : payoffs) pair = {*rc::gen::inRange(0, most + 1), *rc::gen::inRange(-most, 1)};
  const StageGame game("", {"", ""}, {names(rows), names(columns)}, payoffs);
  for (const Seat seat : both_seats) RC_ASSERT(proved(game, seat, minmax(game, seat)));
}

}  // namespace
}  // namespace folk
