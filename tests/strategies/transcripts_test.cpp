// What every strategy answers to fixed opponents, as machine, as player and as table.

#include "csv.h"

#include <folk/strategies/automaton.h>
#include <folk/strategies/registry.h>
#include <gtest/gtest.h>

#include <set>

namespace folk {
namespace {

std::string answers(const Machine& machine, const std::string& theirs) {
  std::string moves;
  State state = machine.start();
  for (const char c : theirs) {
    const Move own = move_of(machine, state);
    moves += to_char(own);
    state = machine.next(state, own, c == 'C' ? Move::C : Move::D);
  }
  return moves;
}

std::string answers(Player& player, const std::string& theirs) {
  player.start({});
  std::string moves;
  for (const char c : theirs) {
    const Move own = player.move();
    moves += to_char(own);
    player.observe(own, c == 'C' ? Move::C : Move::D);
  }
  return moves;
}

TEST(Transcripts, EveryOneIsAnsweredAsPublished) {
  const Registry registry = Registry::standard();
  auto rows = test::read_csv("transcripts.csv");
  ASSERT_GE(rows.size(), 126U);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const Strategy strategy = registry.make(rows[i][0]);
    ASSERT_TRUE(strategy.machine) << rows[i][0];
    EXPECT_EQ(answers(*strategy.machine, rows[i][1]), rows[i][2]) << rows[i][0];
    EXPECT_EQ(answers(*strategy.new_player(), rows[i][1]), rows[i][2]) << rows[i][0] << " as a player";
    const auto rounds = static_cast<unsigned>(rows[i][1].size());
    const Automaton table = unroll(*strategy.machine, Sense::own_moves_its_own, rounds);
    EXPECT_EQ(answers(table, rows[i][1]), rows[i][2]) << rows[i][0] << " as a table";
    EXPECT_EQ(answers(minimise(table, Sense::own_moves_its_own), rows[i][1]), rows[i][2]) << rows[i][0] << " minimised";
  }
}

TEST(Transcripts, EveryDeterministicStrategyOfTheRosterHasThem) {
  std::set<std::string> covered;
  for (const auto& row : test::read_csv("transcripts.csv")) covered.insert(row[0]);
  const std::set<std::string> without_source{"grudger", "lunatic"};  // tested by behaviour in conformance_test.cpp
  for (const auto& strategy : Registry::standard().roster("all"))
    EXPECT_TRUE(covered.count(strategy.name) != 0 || without_source.count(strategy.name) != 0) << strategy.name;
}

}  // namespace
}  // namespace folk
