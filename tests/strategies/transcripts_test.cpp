// What every strategy answers to fixed opponents, as machine, as player and as table.

#include "csv.h"
#include "strategies/named.h"

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

TEST(Transcripts, OfAxelrodPythonAreAnsweredAlike) {
  const Registry registry = Registry::standard();
  const auto rows = test::read_csv("axelrod_plays.csv");
  std::set<std::string> played;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const Strategy strategy = registry.make(rows[i][0]);
    played.insert(strategy.name);
    EXPECT_EQ(answers(*strategy.new_player(), rows[i][1]), rows[i][2]) << rows[i][0];
    if (strategy.machine) {
      EXPECT_EQ(answers(*strategy.machine, rows[i][1]), rows[i][2]) << rows[i][0];
    }
  }
  EXPECT_EQ(played.size(), 151U);
  for (const auto& strategy : registry.roster("axelrod_library")) {
    const bool deterministic = strategy.machine ? strategy.machine->deterministic() : strategy.deterministic;
    EXPECT_EQ(played.contains(strategy.name), deterministic) << strategy.name;
  }
}

/// The player's and the machine's answers while those moves of its own slip that are marked by 1.
std::string slipping_answers(const Strategy& strategy, const std::string& theirs, const std::string& slips) {
  const auto player = strategy.new_player();
  player->start({});
  State state = strategy.machine ? strategy.machine->start() : 0;
  std::string moves;
  for (std::size_t round = 0; round < theirs.size(); ++round) {
    const Move own = player->move();
    if (strategy.machine) {
      EXPECT_EQ(move_of(*strategy.machine, state), own) << strategy.name << " in round " << round + 1;
    }
    moves += to_char(own);
    const Move played = slips[round] == '1' ? other(own) : own;
    const Move answer = theirs[round] == 'C' ? Move::C : Move::D;
    player->observe(played, answer);
    if (strategy.machine) state = strategy.machine->next(state, played, answer);
  }
  return moves;
}

TEST(Transcripts, OfAxelrodPythonAreAnsweredAlikeWhenOwnMovesSlip) {
  const Registry registry = Registry::standard();
  const auto rows = test::read_csv("axelrod_slips.csv");
  EXPECT_EQ(rows.size(), 152U);
  for (std::size_t i = 1; i < rows.size(); ++i)
    EXPECT_EQ(slipping_answers(registry.make(rows[i][0]), rows[i][1], rows[i][2]), rows[i][3]) << rows[i][0];
}

TEST(Transcripts, EveryDeterministicStrategyHasThem) {
  std::set<std::string> covered;
  for (const char* file : {"transcripts.csv", "axelrod_plays.csv"})
    for (const auto& row : test::read_csv(file)) covered.insert(row[0]);
  for (const auto& strategy : test::every_named()) {
    const bool deterministic = strategy.machine ? strategy.machine->deterministic() : strategy.deterministic;
    EXPECT_TRUE(covered.contains(strategy.name) || !deterministic) << strategy.name;
  }
}

}  // namespace
}  // namespace folk
