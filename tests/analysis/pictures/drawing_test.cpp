#include <folk/analysis/pictures/drawing.h>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <string>
#include <vector>

namespace folk {
namespace {

constexpr Sense its_own = Sense::own_moves_its_own;
constexpr Sense any_own = Sense::any_own_moves;

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

Automaton pavlov() { return Automaton({{1.0, {0, 1, 1, 0}}, {0.0, {0, 1, 1, 0}}}, 0); }
Automaton spiteful() { return Automaton({{1.0, {0, 1, 1, 1}}, {0.0, {1, 1, 1, 1}}}, 0); }

TEST(Drawing, OwnMovesItsOwnShowsTheirMoves) {
  const std::string dot = to_dot(pavlov(), {"pavlov", its_own});
  EXPECT_TRUE(contains(dot, "pavlov · edges: their move · own moves its own"));
  EXPECT_TRUE(contains(dot, "s0 -> s0 [label=\" C \"]"));
  EXPECT_TRUE(contains(dot, "s0 -> s1 [label=\" D \"]"));
  EXPECT_TRUE(contains(dot, "s1 -> s0 [label=\" D \"]"));
  EXPECT_TRUE(contains(dot, "s1 -> s1 [label=\" C \"]"));
  EXPECT_TRUE(contains(dot, "start -> s0;"));
  EXPECT_FALSE(contains(dot, "dashed"));
}

TEST(Drawing, OwnMovesAreShownWhereTheyMatter) {
  const std::string dot = to_dot(pavlov(), {"pavlov", any_own});
  EXPECT_TRUE(contains(dot, "edges: own/their move · any own moves"));
  EXPECT_TRUE(contains(dot, "s0 -> s0 [label=\" C/C, D/D \"]"));
  EXPECT_TRUE(contains(dot, "s0 -> s1 [label=\" C/D, D/C \"]"));
}

TEST(Drawing, AStarStandsForEitherMove) {
  const std::string dot = to_dot(spiteful(), {"spiteful", any_own});
  EXPECT_TRUE(contains(dot, "edges: own/their move, * either"));
  EXPECT_TRUE(contains(dot, "s0 -> s0 [label=\" C/C \"]"));
  EXPECT_TRUE(contains(dot, "s0 -> s1 [label=\" C/D, D/* \"]"));
  EXPECT_TRUE(contains(dot, "s1 -> s1 [label=\" */* \"]"));
}

TEST(Drawing, ParallelEdgesAreOne) {
  const std::string dot = to_dot(spiteful(), {"spiteful", its_own});
  EXPECT_TRUE(contains(dot, "s1 -> s1 [label=\" C, D \"]"));
  EXPECT_EQ(count(dot, " -> "), 4U);  // start, two of s0, one of s1
}

TEST(Drawing, MixedStatesShowTheirProbability) {
  const Automaton gtft({{1.0, {0, 1, 0, 1}}, {0.3, {0, 1, 0, 1}}}, 0);
  const std::string dot = to_dot(gtft, {"gtft(0.3)", its_own});
  EXPECT_TRUE(contains(dot, "label=\"P(C)\\n0.3\""));
  EXPECT_TRUE(contains(dot, "P(C): probability of C"));
  EXPECT_TRUE(contains(dot, "edges: their move"));
}

TEST(Drawing, OpeningsAreDashed) {
  const Automaton opening({{0.0, {1, 1, 1, 1}}, {1.0, {1, 1, 1, 1}}}, 0);
  const std::string dot = to_dot(opening, {"opening", its_own});
  EXPECT_EQ(count(dot, "filled,dashed"), 1U);
  EXPECT_TRUE(contains(dot, "dashed: visited at most once"));
}

TEST(Drawing, PastTheHorizonIsAnEllipsisWithoutEdges) {
  const Automaton ladder({{1.0, {1, 1, 1, 1}}, {1.0, {2, 2, 2, 2}}, {1.0, {2, 2, 2, 2}}}, 0, 2);
  const std::string dot = to_dot(ladder, {"ladder", its_own, 2});
  EXPECT_TRUE(contains(dot, "s2 [label=\"…\""));
  EXPECT_FALSE(contains(dot, "s2 ->"));
  EXPECT_TRUE(contains(dot, "ladder · first 2 rounds"));
  EXPECT_FALSE(contains(dot, "dashed"));
}

TEST(Drawing, StatesKeepTheNamesThatTheirAuthorGaveThem) {
  DrawingOptions options{"pavlov", its_own};
  options.state_names = {{"calm"}, {"angry", "a<b", "third", "fourth", "fifth"}};
  const std::string dot = to_dot(pavlov(), options);
  EXPECT_TRUE(contains(dot, "s0 [label=<C<BR/><FONT POINT-SIZE=\"11\">calm</FONT>>, fillcolor"));
  EXPECT_TRUE(contains(dot, "D<BR/><FONT POINT-SIZE=\"11\">angry</FONT><BR/><FONT POINT-SIZE=\"11\">a&lt;b</FONT>"));
  EXPECT_TRUE(contains(dot, "and 2 more"));
  EXPECT_TRUE(contains(dot, "shape=circle"));
  options.state_names = {{"a_name_that_no_circle_holds"}, {}};
  EXPECT_TRUE(contains(to_dot(pavlov(), options), "shape=ellipse"));
  EXPECT_TRUE(contains(to_dot(pavlov(), options), "s1 [label=\"D\""));
}

TEST(Drawing, TheCaptionSaysWhatApplies) {
  DrawingOptions options{"zd", its_own};
  EXPECT_TRUE(contains(to_dot(pavlov(), options), "own moves its own\\nFolk "));
  options.caption.game = "prisoner's \"dilemma\"";
  EXPECT_TRUE(contains(to_dot(pavlov(), options), "\\nprisoner's \\\"dilemma\\\" · Folk "));
}

TEST(Drawing, TextIsDrawn) { EXPECT_EQ(dot_text("a\x1b[31m\xC2\x9B caf\xE9"), R"(a\\x1b[31m\\u{9b} caf\\xe9)"); }

TEST(Drawing, TextIsEscaped) {
  const std::string dot = to_dot(spiteful(), {"a\"b\\c\nd", its_own});
  EXPECT_TRUE(contains(dot, "digraph \"a\\\"b\\\\c d\""));
}

RC_GTEST_PROP(DrawingProperty, EveryStateAndEveryEdgeIsDrawnOnce, ()) {
  const auto size = *rc::gen::inRange<std::uint32_t>(1, 8);
  std::vector<Automaton::Node> nodes(size);
  for (auto& node : nodes) {
    node.cooperation = *rc::gen::element(0.0, 0.25, 1.0);
    for (auto& next : node.next) next = *rc::gen::inRange<std::uint32_t>(0, size);
  }
  const Sense sense = *rc::gen::element(its_own, any_own);
  const std::string dot = to_dot(Automaton(nodes, 0), {"random", sense});
  for (std::uint32_t s = 0; s < size; ++s) {
    RC_ASSERT(count(dot, "\n  s" + std::to_string(s) + " [") == 1U);
    for (std::uint32_t t = 0; t < size; ++t) {
      bool edge = false;
      for (const Outcome outcome : all_outcomes)
        edge = edge || (possible(nodes[s].cooperation, outcome, sense) && nodes[s].next[outcome.index()] == t);
      RC_ASSERT(count(dot, "\n  s" + std::to_string(s) + " -> s" + std::to_string(t) + " [") == (edge ? 1U : 0U));
    }
  }
}

}  // namespace
}  // namespace folk
