#include <folk/mpe/pictures/return_curve.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "mpe/pictures/sample_episode.h"

namespace folk::mpe {
namespace {

using test::sample_episode;

TEST(ReturnCurve, FillsItsBox) {
  const ReturnCurve curve(film_of(sample_episode(), 100), {100, 10}, 50, 30);
  EXPECT_EQ(curve.place(0).x, 100);
  EXPECT_EQ(curve.place(5).x, 150);
  EXPECT_EQ(curve.place(1).y, 40);  // -1, the least
  EXPECT_EQ(curve.place(3).y, 10);  // 29, the most
  EXPECT_NEAR(curve.place(0).y, 39, 1e-9);
}

TEST(ReturnCurve, FlatOrHugeIsDrawnToo) {
  EpisodeRecord record = sample_episode();
  for (auto& row : record.rows) row.rewards.assign(4, 0);
  EXPECT_EQ(ReturnCurve(film_of(record, 100), {0, 0}, 50, 30).place(2).y, 15);
  record.rows[1].rewards[0] = std::numeric_limits<double>::max();
  record.rows[2].rewards[0] = -std::numeric_limits<double>::max();
  record.rows[3].rewards[0] = -std::numeric_limits<double>::max();
  const ReturnCurve curve(film_of(record, 100), {0, 0}, 50, 30);
  EXPECT_EQ(curve.place(1).y, 0);
  EXPECT_EQ(curve.place(3).y, 30);
  record.rows.resize(1);
  EXPECT_TRUE(std::isfinite(ReturnCurve(film_of(record, 100), {0, 0}, 50, 30).place(0).x));
}

}  // namespace
}  // namespace folk::mpe
