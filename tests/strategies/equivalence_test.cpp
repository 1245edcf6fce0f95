#include <folk/strategies/automaton.h>
#include <folk/strategies/equivalence.h>
#include <folk/strategies/registry.h>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace folk {
namespace {

constexpr Sense its_own = Sense::own_moves_its_own;
constexpr Sense any_own = Sense::any_own_moves;

std::shared_ptr<const Machine> machine(const std::string& name) { return Registry::standard().make(name).machine; }

std::string own_moves(const std::vector<Outcome>& play) {
  std::string text;
  for (const Outcome& round : play) text += to_char(round.own);
  return text;
}

std::string their_moves(const std::vector<Outcome>& play) {
  std::string text;
  for (const Outcome& round : play) text += to_char(round.theirs);
  return text;
}

/// A random automaton whose states mostly agree in their answers, so that differences lie deep.
Automaton random_automaton(bool mixing) {
  const auto size = *rc::gen::inRange<std::uint32_t>(1, 7);
  std::vector<Automaton::Node> nodes(size);
  for (auto& node : nodes) {
    node.cooperation = mixing ? *rc::gen::element(0.0, 0.5, 1.0, 1.0) : *rc::gen::element(0.0, 1.0, 1.0);
    for (auto& next : node.next) next = *rc::gen::inRange<std::uint32_t>(0, size);
  }
  return Automaton(std::move(nodes), 0);
}

State after(const Machine& machine, const std::vector<Outcome>& play) {
  State state = machine.start();
  for (const Outcome& round : play) state = machine.next(state, round.own, round.theirs);
  return state;
}

/// True when some play of fewer than `rounds` more rounds separates two states: every play is tried.
bool separable(const Machine& a, State s, const Machine& b, State t, Sense sense, std::size_t rounds) {
  if (rounds == 0) return false;
  if (a.cooperation(s) != b.cooperation(t)) return true;
  for (const auto [own, theirs] : all_outcomes) {
    if (!possible(a.cooperation(s), {own, theirs}, sense)) continue;
    if (separable(a, a.next(s, own, theirs), b, b.next(t, own, theirs), sense, rounds - 1)) return true;
  }
  return false;
}

Sense any_sense() { return *rc::gen::element(its_own, any_own); }

TEST(Equivalence, KnownEqualitiesAreProved) {
  const std::vector<std::pair<std::string, std::string>> equal{
      {"slow_tft", "mem12_ccCCCDCDDD"}, {"hard_tft", "mem02_ccCDDD"},        {"tf2t", "mem02_ccCCCD"},
      {"pavlov", "mem11_cCDDC"},        {"spiteful", "mem11_cCDDD"},         {"tit_for_tat", "mem01_cCD"},
      {"mistrust", "mem01_dCD"},        {"spiteful_cc", "mem12_ccCDCDDDDD"}, {"winner12", "mem12_ccCDCDDCDD"},
      {"winner21", "mem21_dcCDCDCDDD"}};
  for (const auto& [a, b] : equal)
    EXPECT_EQ(compare(*machine(a), *machine(b), its_own).equivalence, Equivalence::equivalent) << a << " and " << b;
}

TEST(Equivalence, SpitefulAndItsTablePartOnceAnOwnMoveSlips) {
  const Comparison found = compare(*machine("spiteful"), *machine("mem11_cCDDD"), any_own);
  ASSERT_EQ(found.equivalence, Equivalence::different);
  // After C against D both defect; an own C that slips in restores the table's C C, not spiteful.
  EXPECT_EQ(own_moves(found.play), "CC");
  EXPECT_EQ(their_moves(found.play), "DC");
  EXPECT_EQ(found.first, 0.0);
  EXPECT_EQ(found.second, 1.0);
}

TEST(Equivalence, TheShortestPlayIsFoundAndPrefersC) {
  const Comparison found = compare(*machine("spiteful"), *machine("tf2t"), its_own);
  ASSERT_EQ(found.equivalence, Equivalence::different);
  EXPECT_EQ(own_moves(found.play), "C");
  EXPECT_EQ(their_moves(found.play), "D");
  EXPECT_EQ(found.depth, 1U);
  EXPECT_EQ(found.first, 0.0);
  EXPECT_EQ(found.second, 1.0);
}

TEST(Equivalence, DifferentFirstMovesNeedNoRound) {
  const Comparison found = compare(*machine("tit_for_tat"), *machine("mistrust"), its_own);
  EXPECT_EQ(found.equivalence, Equivalence::different);
  EXPECT_TRUE(found.play.empty());
  EXPECT_EQ(found.pairs, 1U);
}

TEST(Equivalence, MixingMachinesAreComparedByTheirProbabilities) {
  EXPECT_EQ(compare(*machine("random(0.3)"), *machine("mem1(0.3;0.3,0.3,0.3,0.3)"), any_own).equivalence,
            Equivalence::equivalent);
  EXPECT_EQ(compare(*machine("random(0.3)"), *machine("random(0.31)"), its_own).equivalence, Equivalence::different);
}

TEST(Equivalence, InfiniteMachinesAreRefutedOrLeftUndecided) {
  const auto soft = machine("soft_majo");
  EXPECT_EQ(compare(*soft, *machine("tit_for_tat"), its_own).equivalence, Equivalence::different);
  const Comparison itself = compare(*soft, *soft, its_own, 1000);
  EXPECT_EQ(itself.equivalence, Equivalence::undecided);
  EXPECT_EQ(itself.pairs, 1000U);
  EXPECT_GE(itself.depth, 30U);
}

TEST(Equivalence, TheLimitCountsOnlyDepthsThatWereTriedWhole) {
  // A ladder of six states that only its last one shows: with room for three pairs, plays of up to 2 rounds are tried.
  std::vector<Automaton::Node> nodes(6);
  for (std::uint32_t s = 0; s < 6; ++s) nodes[s].next.fill(std::min(s + 1, 5U));
  nodes[5].cooperation = 0;
  const Automaton ladder(nodes, 0);
  const Automaton cooperator({{1.0, {0, 0, 0, 0}}}, 0);
  const Comparison cut = compare(ladder, cooperator, its_own, 3);
  EXPECT_EQ(cut.equivalence, Equivalence::undecided);
  EXPECT_EQ(cut.depth, 2U);
  const Comparison whole = compare(ladder, cooperator, its_own);
  EXPECT_EQ(whole.equivalence, Equivalence::different);
  EXPECT_EQ(whole.depth, 5U);
}

RC_GTEST_PROP(EquivalenceProperty, MinimisingChangesNothing, ()) {
  const Automaton a = random_automaton(*rc::gen::arbitrary<bool>());
  const Sense sense = any_sense();
  RC_ASSERT(compare(a, minimise(a, sense), sense).equivalence == Equivalence::equivalent);
}

RC_GTEST_PROP(EquivalenceProperty, EquivalentMeansEqualMinimalForms, ()) {
  const Automaton a = random_automaton(false);
  const Automaton b = random_automaton(false);
  const Sense sense = any_sense();
  RC_ASSERT((compare(a, b, sense).equivalence == Equivalence::equivalent) ==
            (minimise(a, sense) == minimise(b, sense)));
}

RC_GTEST_PROP(EquivalenceProperty, OrderDoesNotMatter, ()) {
  const Automaton a = random_automaton(true);
  const Automaton b = random_automaton(true);
  const Sense sense = any_sense();
  const Comparison one = compare(a, b, sense);
  const Comparison two = compare(b, a, sense);
  RC_ASSERT(one.equivalence == two.equivalence);
  RC_ASSERT(one.play == two.play);
  RC_ASSERT(one.first == two.second);
}

RC_GTEST_PROP(EquivalenceProperty, TheOwnSenseIsTheCoarser, ()) {
  const Automaton a = random_automaton(true);
  const Automaton b = random_automaton(true);
  if (compare(a, b, any_own).equivalence == Equivalence::equivalent)
    RC_ASSERT(compare(a, b, its_own).equivalence == Equivalence::equivalent);
}

/// An automaton with one successor changed, so that most differences take some rounds to show.
Automaton variant_of(const Automaton& automaton) {
  std::vector<Automaton::Node> nodes = automaton.nodes();
  const auto size = static_cast<std::uint32_t>(nodes.size());
  nodes[*rc::gen::inRange<std::size_t>(0, size)].next[*rc::gen::inRange<std::size_t>(0, 4)] =
      *rc::gen::inRange<std::uint32_t>(0, size);
  return Automaton(nodes, 0);
}

RC_GTEST_PROP(EquivalenceProperty, ThePlaySeparatesAndNoShorterOneDoes, ()) {
  constexpr std::size_t longest_brute = 8;
  const Automaton a = random_automaton(*rc::gen::arbitrary<bool>());
  const Automaton b = *rc::gen::arbitrary<bool>() ? variant_of(a) : random_automaton(true);
  const Sense sense = any_sense();
  const Comparison found = compare(a, b, sense);
  if (found.equivalence == Equivalence::equivalent) {
    RC_ASSERT(!separable(a, a.start(), b, b.start(), sense, longest_brute));
    return;
  }
  RC_ASSERT(found.equivalence == Equivalence::different);
  RC_ASSERT(found.depth == found.play.size());
  RC_ASSERT(a.cooperation(after(a, found.play)) == found.first);
  RC_ASSERT(b.cooperation(after(b, found.play)) == found.second);
  RC_ASSERT(found.first != found.second);
  State state = a.start();
  for (const Outcome& round : found.play) {  // every round of the play can happen
    RC_ASSERT(possible(a.cooperation(state), round, sense));
    state = a.next(state, round.own, round.theirs);
  }
  RC_ASSERT(!separable(a, a.start(), b, b.start(), sense, std::min(found.play.size(), longest_brute)));
}

}  // namespace
}  // namespace folk
