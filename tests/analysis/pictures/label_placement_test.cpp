#include <folk/analysis/pictures/label_placement.h>

#include <gtest/gtest.h>

#include <cmath>

#include "games/expect_error.h"
#include "games/has.h"

namespace folk {
namespace {

using test::expect_error;
using test::has;

// As dot 2.43 writes it.
const std::string plain =
    "graph 1 3.0 1.5\n"
    "node start 0.05 0.5 0.08 0.08 \"\" solid point black black\n"
    "node s0 0.75 0.5 0.6 0.6 C filled circle black \"#cfe3f7\"\n"
    "node s1 2.25 0.5 0.6 0.6 \"P(C)\\n0.3\" \"filled,dashed\" circle black \"#fcd9b0\"\n"
    "edge start s0 4 0.09 0.5 0.15 0.5 0.25 0.5 0.34 0.5 solid black\n"
    "edge s0 s0 7 0.65 0.79 0.64 0.89 0.67 0.98 0.75 0.98 0.80 0.98 0.83 0.93 0.84 0.88 \" C \" 0.75 1.1 solid black\n"
    "edge s0 s1 4 1.05 0.5 1.3 0.5 1.6 0.5 1.84 0.5 \" C/D, D/* \" 1.5 0.6 solid black\n"
    "stop\n";

constexpr double head = 8;
constexpr double size = 12;

TEST(ReadPlain, NodesEdgesAndLabels) {
  const GraphLayout layout = read_plain(plain, head);
  ASSERT_EQ(layout.nodes.size(), 3U);
  EXPECT_EQ(layout.nodes[2].name, "s1");
  EXPECT_DOUBLE_EQ(layout.nodes[2].centre.x, 162);
  EXPECT_DOUBLE_EQ(layout.nodes[2].half_height, 21.6);
  ASSERT_EQ(layout.edges.size(), 3U);
  EXPECT_EQ(layout.edges[0].label, "");
  EXPECT_EQ(layout.edges[1].curve.size(), 7U);
  EXPECT_EQ(layout.edges[2].label, "C/D, D/*");
  EXPECT_DOUBLE_EQ(layout.edges[2].label_at.x, 108);
  EXPECT_NEAR(layout.edges[2].tip.x, 162 - 21.6, 1e-9);  // an arrow ends at its node
}

TEST(ReadPlain, RefusesWhatIsNoLayout) {
  for (const char* text : {"", "graph 1 1 1\n", "node a x 1 1 1\nstop\n", "node a 1\nstop\n", "edge a b 4 1 1\nstop\n",
                           "nonsense\nstop\n", "node a 1 1 1 1\nedge a a 3 1 1 1 1 1 1\nstop\n",
                           "node a 1 1 1 1\nedge a a 1e30 1 1\nstop\n", "node a nan 1 1 1\nstop\n"})
    expect_error<EnvironmentError>([&] { read_plain(text, head); }, "layout cannot be read");
}

TEST(PlaceLabels, ALabelLiesOnItsOwnEdge) {
  GraphLayout layout = read_plain(plain, head);
  place_labels(layout, size, head);
  EXPECT_NEAR(layout.edges[2].label_at.y, 36, 0.5);
  EXPECT_GT(layout.edges[2].label_at.x, 75.6);
  EXPECT_LT(layout.edges[2].label_at.x, 140.4);
}

TEST(PlaceLabels, ALoopTurnsAwayFromWhatEntersItsNode) {
  GraphLayout layout = read_plain(plain, head);
  // Edges that come down onto s0 from above, where the loop and its label were.
  for (const double x : {0.55, 0.65, 0.75, 0.85, 0.95}) {
    layout.nodes.push_back({"t", {72 * x, 144}, 3, 3});
    PlacedEdge edge;
    edge.from = layout.nodes.size() - 1;
    edge.to = 1;
    edge.curve = {{72 * x, 140}, {72 * x, 120}, {72 * x, 90}, {72 * x, 65}};
    edge.tip = {72 * x, 57};
    layout.edges.push_back(edge);
  }
  EXPECT_GT(edges_under_label(layout, 1, size), 0U);
  place_labels(layout, size, head);
  EXPECT_EQ(edges_under_label(layout, 1, size), 0U);
  EXPECT_LT(layout.edges[1].label_at.y, 36);  // below the node
}

TEST(PlaceLabels, LabelsGiveWayToOtherEdgesAndToEachOther) {
  // Two edges that cross in the middle of both: neither label can be there.
  GraphLayout layout;
  layout.nodes = {{"a", {0, 0}, 10, 10}, {"b", {200, 200}, 10, 10}, {"c", {0, 200}, 10, 10}, {"d", {200, 0}, 10, 10}};
  layout.edges = {{0, 1, {{7, 7}, {60, 60}, {130, 130}, {187, 187}}, {193, 193}, "C", {100, 100}},
                  {2, 3, {{7, 193}, {60, 140}, {130, 70}, {187, 13}}, {193, 7}, "D", {100, 100}}};
  EXPECT_EQ(edges_under_label(layout, 0, size), 1U);
  place_labels(layout, size, head);
  EXPECT_EQ(edges_under_label(layout, 0, size), 0U);
  EXPECT_EQ(edges_under_label(layout, 1, size), 0U);
  const Spot& a = layout.edges[0].label_at;
  const Spot& b = layout.edges[1].label_at;
  EXPECT_GT(std::hypot(a.x - b.x, a.y - b.y), 10);
}

TEST(WithPlaces, LabelsAreDrawnOverAllLines) {
  const GraphLayout layout = read_plain(plain, head);
  const std::string dot = with_places("digraph \"a } b\" {\n  start -> s0;\n}\n", layout, size);
  EXPECT_TRUE(dot.starts_with("strict digraph \"a } b\" {\n  start -> s0;\n")) << dot;
  EXPECT_TRUE(has(dot, "outputorder=edgesfirst;"));
  EXPECT_TRUE(has(dot, "  s1 [pos=\"162.00,36.00\"];\n"));
  EXPECT_TRUE(has(dot, "  s0 -> s1 [label=\"\", pos=\"e,140.40,36.00 75.60,36.00 "));
  EXPECT_TRUE(has(dot, "fillcolor=white"));
  EXPECT_TRUE(has(dot, "label=\"C/D, D/*\", pos=\"108.00,43.20\""));
  EXPECT_TRUE(dot.ends_with("}\n"));
}

}  // namespace
}  // namespace folk
