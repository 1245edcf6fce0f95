#include <folk/analysis/folk_theorem/convex_polygon.h>
#include <folk/games/rational.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace folk {
namespace {

using Shape = Polygon<Rational>;

TEST(ConvexPolygon, HullLeavesOutWhatIsInsideOrInLine) {
  const Shape square = convex_hull(Shape{{2, 0}, {1, 1}, {0, 0}, {0, 2}, {1, 0}, {2, 2}, {0, 1}, {2, 2}});
  EXPECT_EQ(square, (Shape{{0, 0}, {2, 0}, {2, 2}, {0, 2}}));
}

TEST(ConvexPolygon, HullOfFewPoints) {
  EXPECT_TRUE(convex_hull(Shape{}).empty());
  EXPECT_EQ(convex_hull(Shape{{1, 2}, {1, 2}}), (Shape{{1, 2}}));
  EXPECT_EQ(convex_hull(Shape{{3, 3}, {1, 1}, {2, 2}}), (Shape{{1, 1}, {3, 3}}));
  EXPECT_EQ(convex_hull(Shape{{1, 3}, {1, 1}, {1, 2}}), (Shape{{1, 1}, {1, 3}}));
}

TEST(ConvexPolygon, ClippedAtALine) {
  const Rational half(1, 2);
  const Shape square{{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  EXPECT_EQ(clipped<Rational>(square, 0, half), (Shape{{half, 0}, {2, 0}, {2, 2}, {half, 2}}));
  EXPECT_EQ(clipped<Rational>(square, 1, 0), square);
  EXPECT_EQ(clipped<Rational>(square, 1, 2), (Shape{{0, 2}, {2, 2}}));
  EXPECT_TRUE(clipped<Rational>(square, 1, 3).empty());
  EXPECT_EQ(clipped<Rational>({{0, 0}, {2, 4}}, 1, 1), (Shape{{half, 1}, {2, 4}}));
  EXPECT_EQ(clipped<Rational>({{0, 0}}, 1, 0), (Shape{{0, 0}}));
}

RC_GTEST_PROP(ConvexPolygon, HullIsConvexAndHoldsEveryPoint, ()) {
  const auto coordinates = *rc::gen::container<std::vector<std::array<int, 2>>>(
      rc::gen::container<std::array<int, 2>>(rc::gen::inRange(-5, 6)));
  Shape points;
  for (const auto& [x, y] : coordinates) points.push_back({x, y});
  const Shape hull = convex_hull(points);
  for (std::size_t i = 0; hull.size() > 2 && i < hull.size(); ++i) {
    const auto& next = hull[(i + 1) % hull.size()];
    RC_ASSERT(turn(hull[i], next, hull[(i + 2) % hull.size()]) > 0);
    for (const auto& point : points) RC_ASSERT(turn(hull[i], next, point) >= 0);
  }
  for (const auto& corner : hull) RC_ASSERT(std::find(points.begin(), points.end(), corner) != points.end());
}

}  // namespace
}  // namespace folk
