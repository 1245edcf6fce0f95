// What the plays of axelrod_plays.csv do not show: players that draw, and balances in long matches.

#include "strategies/named.h"

#include <folk/strategies/axelrod/rule.h>
#include <folk/strategies/axelrod/windows.h>
#include <gtest/gtest.h>

namespace folk {
namespace {

TEST(RulePlayer, DrawsWithTheProbabilitiesOfItsMachine) {
  int cooperations = 0;
  for (std::uint64_t match = 0; match < 4000; ++match) {
    const Strategy tullock = played_by_rule<Tullock>("tullock", false);
    const auto player = tullock.new_player();
    player->start({{}, Criterion::finite(100), {3, match, 0, 0}});
    for (int round = 0; round < 11; ++round) {
      EXPECT_EQ(player->move(), Move::C);
      player->observe(Move::C, round < 5 ? Move::D : Move::C);
    }
    cooperations += player->move() == Move::C ? 1 : 0;
  }
  EXPECT_NEAR(cooperations / 4000.0, 0.5, 0.04);  // six C of ten, less a tenth; five standard errors
}

TEST(Grumpy, TurnsAtElevenAheadEitherWay) {
  const auto player = test::named("grumpy").new_player();
  player->start({});
  const auto rounds_until = [&](Move theirs, Move own) {
    int rounds = 0;
    for (; player->move() != own; ++rounds) player->observe(player->move(), theirs);
    return rounds;
  };
  EXPECT_EQ(rounds_until(Move::D, Move::D), 11);
  EXPECT_EQ(rounds_until(Move::C, Move::C), 22);
  EXPECT_EQ(rounds_until(Move::D, Move::D), 22);
}

}  // namespace
}  // namespace folk
