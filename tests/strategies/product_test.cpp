#include <folk/strategies/product.h>
#include <folk/strategies/registry.h>
#include <gtest/gtest.h>

namespace folk {
namespace {

Automaton table(const char* name, Sense sense) {
  return minimise(*tabulate(*Registry::standard().make(name).machine, sense), sense);
}

TEST(Product, FollowsTheirOwnMovesOrAll) {
  const auto tft = table("tit_for_tat", Sense::any_own_moves);
  const auto mistrust = table("mistrust", Sense::any_own_moves);
  EXPECT_EQ(product(tft, tft, Sense::own_moves_its_own)->size(), 1U);
  EXPECT_EQ(product(tft, tft, Sense::any_own_moves)->size(), 4U);
  // C D, D C, and round again.
  const auto feud = *product(tft, mistrust, Sense::own_moves_its_own);
  ASSERT_EQ(feud.size(), 2U);
  EXPECT_EQ((feud[0].next[Outcome{Move::C, Move::D}.index()]), 1U);
  EXPECT_EQ((feud[1].next[Outcome{Move::D, Move::C}.index()]), 0U);
}

TEST(Product, IsNothingWhenItIsTooLarge) {
  const auto tft = table("tit_for_tat", Sense::any_own_moves);
  EXPECT_FALSE(product(tft, tft, Sense::any_own_moves, 3));
}

}  // namespace
}  // namespace folk
