#include <folk/games/random.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <vector>

namespace folk {
namespace {

std::vector<std::uint64_t> draws(const RandomKey& key, std::size_t count) {
  RandomStream stream(key);
  std::vector<std::uint64_t> values(count);
  for (auto& value : values) value = stream();
  return values;
}

// Known answers of Random123's own test (kat_vectors: philox4x64, 10 rounds, counter and key zero).
TEST(RandomStream, IsPhilox4x64) {
  EXPECT_EQ(draws({.seed = 0}, 4), (std::vector<std::uint64_t>{0x16554d9eca36314c, 0xdb20fe9d672d0fdc,
                                                               0xd7e772cee186176b, 0x7e68b68aec7ba23b}));
}

RC_GTEST_PROP(RandomStream, SameKeySameNumbers,
              (std::uint64_t seed, std::uint64_t pair, std::uint64_t repetition, std::uint64_t role)) {
  const RandomKey key{seed, pair, repetition, role};
  RC_ASSERT(draws(key, 9) == draws(key, 9));
}

TEST(RandomStream, EveryPartOfTheKeyMatters) {
  std::set<std::vector<std::uint64_t>> seen;
  for (std::uint64_t a = 0; a < 3; ++a)
    for (std::uint64_t b = 0; b < 3; ++b)
      for (std::uint64_t c = 0; c < 3; ++c)
        for (std::uint64_t d = 0; d < 4; ++d) seen.insert(draws({a, b, c, d}, 2));
  EXPECT_EQ(seen.size(), 3U * 3U * 3U * 4U);
}

TEST(RandomStream, NumbersDoNotRepeat) {
  const auto values = draws({}, 10'000);
  EXPECT_EQ(std::set<std::uint64_t>(values.begin(), values.end()).size(), values.size());
}

TEST(RandomStream, IsRoughlyUniform) {
  RandomStream stream({.seed = 42});
  constexpr int count = 100'000;
  std::array<int, 10> bins{};
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    const double u = stream.uniform();
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    sum += u;
    ++bins[static_cast<std::size_t>(u * 10)];
  }
  EXPECT_NEAR(sum / count, 0.5, 4 * std::sqrt(1.0 / 12 / count));
  double chi_square = 0;
  for (const int bin : bins) chi_square += (bin - count / 10.0) * (bin - count / 10.0) / (count / 10.0);
  EXPECT_LT(chi_square, 27.9);  // 9 degrees of freedom, 1 in 1000
}

TEST(RandomStream, ChanceKeepsItsEnds) {
  RandomStream stream;
  int successes = 0;
  for (int i = 0; i < 100'000; ++i) {
    EXPECT_FALSE(stream.chance(0));
    EXPECT_TRUE(stream.chance(1));
    successes += stream.chance(0.05) ? 1 : 0;
  }
  EXPECT_NEAR(successes, 5000, 4 * std::sqrt(100'000 * 0.05 * 0.95));
}

}  // namespace
}  // namespace folk
