#include "analysis/play/naive.h"

#include <folk/analysis/play/cycle_table.h>
#include <folk/analysis/play/deterministic_play.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace folk {
namespace {

RC_GTEST_PROP(CycleFinder, AgreesWithNaivePlay, ()) {
  RandomStream random({*rc::gen::arbitrary<std::uint64_t>(), 0, 0, 0});
  CycleFinder finder;
  // One finder for many pairs of different sizes: marks of earlier pairs must not be mistaken for its own.
  for (int i = 0; i < 20; ++i) {
    const Automaton a = test::random_automaton(random, 30, true);
    const Automaton b = test::random_automaton(random, 30, true);
    const std::uint64_t rounds = 1 + random() % 3000;
    const auto exact = finder.play(CycleTable(a), CycleTable(b), Criterion::finite(rounds));
    RC_ASSERT(exact.weights == test::play_naively(a, b, rounds));
  }
}

RC_GTEST_PROP(CycleFinder, AgreesWithTheGeneralMethodUnderEveryCriterion, ()) {
  RandomStream random({*rc::gen::arbitrary<std::uint64_t>(), 1, 0, 0});
  const Automaton a = test::random_automaton(random, 40, true);
  const Automaton b = test::random_automaton(random, 40, true);
  CycleFinder finder;
  for (const auto& criterion : {Criterion::finite(1'000'000'000'000'000), Criterion::finite(7), Criterion::mean(),
                                Criterion::discounted(0.9), Criterion::ending(0.001), Criterion::ending(1)}) {
    const auto fast = finder.play(CycleTable(a), CycleTable(b), criterion);
    const auto general = play_deterministic(a, b, criterion);
    for (std::size_t o = 0; o < 4; ++o)
      RC_ASSERT(std::abs(fast.weights[o] - general.weights[o]) <= 1e-11 * criterion.total_weight());
  }
}

/// States in a ring, D in the first alone.
Automaton ring(std::uint32_t size) {
  std::vector<Automaton::Node> nodes;
  for (std::uint32_t s = 0; s < size; ++s) {
    const std::uint32_t next = (s + 1) % size;
    nodes.push_back({s == 0 ? 0.0 : 1.0, {next, next, next, next}});
  }
  return Automaton(std::move(nodes), 0);
}

TEST(CycleFinder, IsRightWhereItsMarksWouldOverflow) {
  // 251 and 257 have no common divisor: a lap of the pair passes through all 64,507 joint states.
  const CycleTable first(ring(251));
  const CycleTable second(ring(257));
  const OutcomeWeights lap{250.0 * 256, 250, 256, 1};
  CycleFinder finder(CycleFinder::last_epoch);  // the third lap would end above 2^32
  for (int i = 0; i < 8; ++i) ASSERT_EQ(finder.play(first, second, Criterion::finite(251 * 257)).weights, lap) << i;
}

TEST(CycleFinder, KnowsWhatFits) {
  const Automaton small({{1, {0, 0, 0, 0}}}, 0);
  EXPECT_TRUE(CycleFinder::fits(CycleTable(small), CycleTable(small)));
  std::vector<Automaton::Node> nodes(300, {1, {0, 0, 0, 0}});
  const CycleTable large(Automaton(nodes, 0));
  EXPECT_FALSE(CycleFinder::fits(large, large));
}

}  // namespace
}  // namespace folk
