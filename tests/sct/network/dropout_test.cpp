// What is dropped: as often as asked, and by the key alone.

#include <Random123/philox.h>
#include <folk/sct/network/dropout.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

namespace folk::sct {
namespace {

constexpr std::size_t many = 1U << 18U;

std::vector<std::uint8_t> mask(const Dropout& dropout, std::size_t window = 0, std::size_t site = 0,
                               std::size_t count = many) {
  std::vector<std::uint8_t> keep(count, 9);
  dropout.keep(keep.data(), count, window, site);
  return keep;
}

/// How often two masks agree, in standard deviations from what independence would give.
double surprise(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b, double p) {
  double agree = 0;
  for (std::size_t i = 0; i < a.size(); ++i) agree += a[i] == b[i] ? 1 : 0;
  const double chance = p * p + (1 - p) * (1 - p);
  const double size = static_cast<double>(a.size());
  return std::abs(agree - chance * size) / std::sqrt(size * chance * (1 - chance));
}

TEST(Dropout, KeepsItsShareAndScalesTheMeanBack) {
  for (const double p : {0.1, 0.25, 0.5, 0.9}) {
    const Dropout dropout(p, 11, 12);
    EXPECT_TRUE(dropout.active());
    EXPECT_NEAR(dropout.scale() * (1 - p), 1, 1e-4);
    const auto keep = mask(dropout);
    const double kept = std::accumulate(keep.begin(), keep.end(), 0.0);
    EXPECT_NEAR(kept, many * (1 - p), 5 * std::sqrt(many * p * (1 - p))) << p;
    for (const auto k : keep) ASSERT_LE(k, 1);
  }
}

TEST(Dropout, OfNothingIsOff) {
  EXPECT_FALSE(Dropout().active());
  EXPECT_FALSE(Dropout(0, 1, 2).active());
  EXPECT_EQ(Dropout().scale(), 1);
}

TEST(Dropout, DropsTheSameForTheSameKeyWhateverTheCount) {
  const auto keep = mask(Dropout(0.3, 1, 2, 1), 3, 4);
  EXPECT_EQ(mask(Dropout(0.3, 1, 2, 1), 3, 4), keep);
  for (const std::size_t count : {0U, 1U, 7U, 8U, 9U, 1001U}) {
    const auto part = mask(Dropout(0.3, 1, 2, 1), 3, 4, count);
    EXPECT_TRUE(std::equal(part.begin(), part.end(), keep.begin()));
  }
}

TEST(Dropout, DropsIndependentlyForEveryOtherKey) {
  const auto keep = mask(Dropout(0.3, 1, 2, 0), 3, 4);
  const std::vector<std::vector<std::uint8_t>> others{
      mask(Dropout(0.3, 7, 2, 0), 3, 4), mask(Dropout(0.3, 1, 3, 0), 3, 4), mask(Dropout(0.3, 1, 2, 1), 3, 4),
      mask(Dropout(0.3, 1, 2, 0), 4, 4), mask(Dropout(0.3, 1, 2, 0), 3, 5), mask(Dropout(0.3, 1, 2, 0), 4, 3)};
  for (const auto& other : others) EXPECT_LT(surprise(keep, other, 0.3), 5);
}

/// The decisions are 16 bits each of Random123's blocks, whose counters are (block, window, site and pass, step): the
/// same blocks hold the same halves, whatever order they are taken in.
TEST(Dropout, DrawsFromPhilox) {
  constexpr double p = 0.25;
  constexpr std::uint64_t seed = 0x123456789ABCDEF0;
  const auto keep = mask(Dropout(p, seed, 7, 1), 5, 6, 4096);
  std::size_t kept = 0;
  for (std::uint32_t block = 0; block < 4096 / 8; ++block) {
    const r123::Philox4x32::key_type key{{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32U)}};
    const auto words = r123::Philox4x32{}({{block, 5, 6U | 1U << 24U, 7}}, key);
    for (const auto word : words.v)
      for (const auto half : {word & 0xFFFFU, word >> 16U}) kept += half >= p * 65536 ? 1U : 0U;
  }
  EXPECT_EQ(static_cast<std::size_t>(std::accumulate(keep.begin(), keep.end(), 0)), kept);
}

TEST(Dropout, DropsMoreWithAHigherProbability) {
  const auto few = mask(Dropout(0.2, 1, 2));
  const auto more = mask(Dropout(0.4, 1, 2));
  for (std::size_t i = 0; i < many; ++i) ASSERT_LE(more[i], few[i]);
}

}  // namespace
}  // namespace folk::sct
