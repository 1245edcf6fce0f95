#include <folk/analysis/pictures/box_summary.h>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace folk {
namespace {

TEST(BoxSummary, of_a_small_sample_as_r_and_numpy_have_it) {
  const auto box = box_summary({7, 1, 3, 5});
  ASSERT_TRUE(box);
  EXPECT_DOUBLE_EQ(box->mean, 4);
  EXPECT_DOUBLE_EQ(box->median, 4);
  EXPECT_DOUBLE_EQ(box->lower_quartile, 2.5);
  EXPECT_DOUBLE_EQ(box->upper_quartile, 5.5);
  EXPECT_DOUBLE_EQ(box->lower_whisker, 1);
  EXPECT_DOUBLE_EQ(box->upper_whisker, 7);
  EXPECT_TRUE(box->outliers.empty());
}

TEST(BoxSummary, outliers_lie_beyond_the_whiskers) {
  const auto box = box_summary({0, 10, 11, 12, 13, 14, 40});
  ASSERT_TRUE(box);
  EXPECT_DOUBLE_EQ(box->lower_whisker, 10);
  EXPECT_DOUBLE_EQ(box->upper_whisker, 14);
  EXPECT_EQ(box->outliers, (std::vector<double>{0, 40}));
}

TEST(BoxSummary, leaves_out_what_is_not_finite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(box_summary({}));
  EXPECT_FALSE(box_summary({nan, INFINITY}));
  EXPECT_DOUBLE_EQ(box_summary({nan, 2})->median, 2);
}

RC_GTEST_PROP(BoxSummary, is_ordered_and_loses_no_value, ()) {
  auto values = *rc::gen::nonEmpty(rc::gen::container<std::vector<double>>(
      rc::gen::map(rc::gen::inRange(-1000, 1000), [](int i) { return i / 10.0; })));
  const auto box = box_summary(values);
  RC_ASSERT(box.has_value());
  RC_ASSERT(box->lower_whisker <= box->lower_quartile);
  RC_ASSERT(box->lower_quartile <= box->median);
  RC_ASSERT(box->median <= box->upper_quartile);
  RC_ASSERT(box->upper_quartile <= box->upper_whisker);
  const auto beyond = std::count_if(values.begin(), values.end(), [&](double value) {
    return value < box->lower_whisker || value > box->upper_whisker;
  });
  RC_ASSERT(static_cast<std::size_t>(beyond) == box->outliers.size());
}

}  // namespace
}  // namespace folk
