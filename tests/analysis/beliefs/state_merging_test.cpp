#include <folk/analysis/beliefs/state_merging.h>
#include <folk/strategies/machine_text.h>
#include <folk/strategies/registry.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace folk {
namespace {

Automaton machine(const std::string& name) {
  return minimise(*tabulate(*Registry::standard().make(name).machine, Sense::own_moves_its_own),
                  Sense::own_moves_its_own);
}

/// All play of an opponent in the first rounds.
PrefixTree all_play(const Machine& machine, unsigned depth) {
  PrefixTree tree;
  for (unsigned bits = 0; bits < (1U << depth); ++bits) {
    std::vector<Move> own;
    std::vector<Move> theirs;
    State state = machine.start();
    for (unsigned t = 0; t <= depth; ++t) {
      own.push_back(move_of(machine, state));
      if (t == depth) break;
      theirs.push_back(move_from_bit(bits >> t));
      state = machine.next(state, own.back(), theirs.back());
    }
    tree.add(own, theirs);
  }
  return tree;
}

TEST(StateMerging, FindsMachinesFromAllTheirPlay) {
  for (const char* name :
       {"all_c", "all_d", "tit_for_tat", "tf2t", "spiteful", "pavlov", "per_ccd", "hard_tft", "slow_tft", "mistrust"}) {
    const auto merged = merge_states(all_play(machine(name), 8), 0);
    EXPECT_EQ(merged.machine, machine(name)) << name;
    EXPECT_EQ(merged.wrong, 0);
    EXPECT_EQ(merged.weight, 256 * 9);
  }
}

TEST(StateMerging, WithoutAPriceMovesAsWasSeen) {
  for (const char* name : {"gradual", "prober", "hard_majo"}) {
    const auto whole = Registry::standard().make(name).machine;
    const auto tree = all_play(*whole, 7);
    const auto merged = merge_states(tree, 0);
    EXPECT_EQ(merged.wrong, 0);
    for (unsigned bits = 0; bits < 128; ++bits) {
      State state = whole->start();
      State copy = merged.machine.start();
      for (unsigned t = 0; t < 7; ++t) {
        const Move own = move_of(*whole, state);
        ASSERT_EQ(move_of(merged.machine, copy), own);
        state = whole->next(state, own, move_from_bit(bits >> t));
        copy = merged.machine.next(copy, own, move_from_bit(bits >> t));
      }
    }
  }
}

TEST(StateMerging, AStateIsMadeWhereItSavesMoreThanItsPrice) {
  // Tit-for-tat, but for three strange moves after CCC.
  PrefixTree tree = all_play(machine("tit_for_tat"), 6);
  const std::vector<Move> strange{Move::C, Move::C, Move::C, Move::D};
  for (int i = 0; i < 3; ++i) tree.add(strange, std::vector<Move>(3, Move::C));
  const auto cheap = merge_states(tree, 100);
  EXPECT_EQ(cheap.machine, machine("tit_for_tat"));
  EXPECT_EQ(cheap.wrong, 3);
}

TEST(StateMerging, SaysWhatWasNeverSeen) {
  PrefixTree tree;
  tree.add(std::vector<Move>{Move::C, Move::D}, std::vector<Move>{Move::D});
  const auto merged = merge_states(tree, 0);
  EXPECT_EQ(merged.machine.size(), 2U);
  EXPECT_EQ(merged.unseen_moves, 3U);
  EXPECT_EQ(merged.machine.nodes()[1].next[0], 1U) << "it stays";
}

TEST(StateMerging, ReadsBackFromItsText) {
  const auto merged = merge_states(all_play(machine("tf2t"), 6), 0);
  const auto read = read_machines(write_machine("extracted", merged.machine), "text");
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read[0].machine, merged.machine);
}

TEST(PrefixTree, WantsTheirMoves) {
  PrefixTree tree;
  EXPECT_THROW(tree.add(std::vector<Move>(3, Move::C), std::vector<Move>(1, Move::C)), std::logic_error);
}

}  // namespace
}  // namespace folk
