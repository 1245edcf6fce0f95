#include <folk/strategies/facts.h>
#include <folk/strategies/registry.h>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstdint>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <vector>

namespace folk {
namespace {

Facts facts(const std::string& name) { return facts_of(*Registry::standard().make(name).machine); }

TEST(Facts, MemoryOfKnownStrategies) {
  const std::map<std::string, std::string> known{
      {"all_c", "0"},          {"all_d", "0"},        {"tit_for_tat", "1"},      {"mistrust", "1"},
      {"tf2t", "2"},           {"hard_tft", "2"},     {"spiteful", "1"},         {"per_cd", "1"},
      {"per_ccd", "2"},        {"per_ddc", "2"},      {"slow_tft", "2"},         {"pavlov", "1"},
      {"prober", "unbounded"}, {"mem2", "unbounded"}, {"gradual", "unbounded"},  {"random(0.3)", "0"},
      {"gtft(0.3)", "1"},      {"winner12", "2"},     {"soft_majo", "unbounded"}};
  for (const auto& [name, memory] : known) EXPECT_EQ(to_string(facts(name).memory), memory) << name;
}

TEST(Facts, StatesInBothSenses) {
  EXPECT_EQ(facts("all_c").states, 1U);
  EXPECT_EQ(facts("tit_for_tat").states, 2U);
  EXPECT_EQ(facts("tf2t").states, 3U);
  EXPECT_EQ(facts("per_ccd").states, 3U);
  EXPECT_EQ(facts("mem11_cCDDD").states, 2U);
  EXPECT_EQ(facts("mem11_cCDDD").states_any_own_moves, 2U);
  EXPECT_EQ(facts("soft_majo").states, std::nullopt);
}

TEST(Facts, Niceness) {
  for (const char* name : {"all_c", "tit_for_tat", "spiteful", "pavlov", "tf2t", "slow_tft", "mem2"}) {
    EXPECT_TRUE(facts(name).niceness.nice) << name;
    EXPECT_EQ(facts(name).niceness.rounds_tried, std::nullopt) << name;
  }
  for (const char* name : {"all_d", "mistrust", "prober", "per_ccd", "hard_majo", "lunatic", "joss(0.9)"})
    EXPECT_FALSE(facts(name).niceness.nice) << name;
  EXPECT_TRUE(facts("soft_majo").niceness.nice);
  EXPECT_EQ(facts("soft_majo").niceness.rounds_tried, 10'000U);
}

TEST(Facts, DeterministicAndFinite) {
  EXPECT_TRUE(facts("pavlov").deterministic);
  EXPECT_FALSE(facts("gtft(0.3)").deterministic);
  EXPECT_TRUE(facts("pavlov").finite);
  EXPECT_FALSE(facts("hard_majo").finite);
}

TEST(Facts, OfALargeMachineOnlyUnboundedMemoryIsSeen) {
  const Automaton alternator({{1.0, {1, 1, 1, 1}}, {0.0, {0, 0, 0, 0}}}, 0);
  EXPECT_EQ(to_string(memory_of(alternator, 1)), "?");
  EXPECT_EQ(to_string(memory_of(alternator, 2)), "1");
  const Automaton prober = minimise(*tabulate(*Registry::standard().make("prober").machine, Sense::own_moves_its_own),
                                    Sense::own_moves_its_own);
  EXPECT_EQ(to_string(memory_of(prober, 1)), "unbounded");
}

TEST(Facts, AStateWithoutEndIsUnbounded) {
  // Looks at round 1 only: all_c after C, all_d after D. Its own move shows which, but for the D that may be round 1's.
  const Automaton chooser({{1.0, {1, 2, 1, 2}}, {1.0, {1, 1, 1, 1}}, {0.0, {2, 2, 2, 2}}}, 0);
  EXPECT_EQ(to_string(memory_of(minimise(chooser, Sense::own_moves_its_own))), "2");
  // Two states that play alike until a D: which of them it is depends on round 1 for as long as they play C.
  const Automaton keeper({{1.0, {1, 2, 1, 2}}, {1.0, {1, 3, 1, 3}}, {1.0, {2, 2, 2, 2}}, {0.0, {3, 3, 3, 3}}}, 0);
  EXPECT_EQ(to_string(memory_of(minimise(keeper, Sense::own_moves_its_own))), "unbounded");
}

/// True when every run of `rounds` rounds that can happen leads all states in which it can start to one.
bool determined_by(const Automaton& automaton, const std::vector<std::uint32_t>& from, std::size_t rounds) {
  if (from.size() <= 1) return true;
  if (rounds == 0) return false;
  for (const Outcome outcome : all_outcomes) {
    std::set<std::uint32_t> to;
    for (const std::uint32_t s : from)
      if (possible(automaton.nodes()[s].cooperation, outcome, Sense::own_moves_its_own))
        to.insert(automaton.nodes()[s].next[outcome.index()]);
    if (!determined_by(automaton, {to.begin(), to.end()}, rounds - 1)) return false;
  }
  return true;
}

RC_GTEST_PROP(FactsProperty, MemoryIsTheSmallestNumberOfRoundsThatDetermineTheState, ()) {
  const auto size = *rc::gen::inRange<std::uint32_t>(1, 6);
  std::vector<Automaton::Node> nodes(size);
  for (auto& node : nodes) {
    node.cooperation = *rc::gen::element(0.0, 0.0, 1.0, 1.0, 0.5);
    for (auto& next : node.next) next = *rc::gen::inRange<std::uint32_t>(0, size);
  }
  const Automaton automaton = minimise(Automaton(nodes, 0), Sense::own_moves_its_own);
  std::vector<std::uint32_t> all(automaton.size());
  std::iota(all.begin(), all.end(), 0U);
  const Memory memory = memory_of(automaton);
  RC_ASSERT(memory.kind != Memory::Kind::unknown);
  if (memory.kind == Memory::Kind::rounds) RC_ASSERT(determined_by(automaton, all, memory.rounds));
  const std::size_t fewer = memory.kind == Memory::Kind::rounds ? memory.rounds : 11;
  if (fewer > 0) RC_ASSERT(!determined_by(automaton, all, fewer - 1));
}

}  // namespace
}  // namespace folk
