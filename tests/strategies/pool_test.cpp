#include <folk/strategies/pool.h>

#include <folk/games/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "named.h"

namespace folk {
using test::named;
using test::roster;

namespace {

std::vector<std::string> drawn(const Pool& pool, std::uint64_t count, std::uint64_t seed) {
  std::vector<std::string> names;
  for (const auto& strategy : sample_of(pool, count, seed)) names.push_back(strategy.name);
  return names;
}

/// per_c, per_d, per_cc, per_dd: a family that is small and counts as too large to be listed.
Family four_words() {
  return {"words", 4, [](const Integer& number) {
            const char move = number.word() % 2 == 0 ? 'c' : 'd';
            return named("per_" + std::string(number.word() < 2 ? 1 : 2, move));
          }};
}

TEST(SampleOf, DrawsEverySetAlikeOften) {
  const Pool listed{roster("all_c,all_d,pavlov,tit_for_tat"), {}};
  const Pool both{roster("per_cc,pavlov"), {four_words()}};  // five strategies, per_cc in both
  for (const auto& [pool, sets] : {std::pair{listed, 6.0}, std::pair{both, 10.0}}) {
    constexpr int samples = 3000;
    std::map<std::vector<std::string>, int> seen;
    for (std::uint64_t seed = 0; seed < samples; ++seed) ++seen[drawn(pool, 2, seed)];
    EXPECT_EQ(static_cast<double>(seen.size()), sets);
    double chi_square = 0;
    for (const auto& [names, count] : seen) {
      const double excess = count - samples / sets;
      chi_square += excess * excess / (samples / sets);
    }
    EXPECT_LT(chi_square, 35);  // 1e-4 of the chi-square with 9 degrees of freedom lies above 33.7
  }
}

TEST(SampleOf, HoldsTheSmallerSampleOfTheSeed) {
  const Pool pool{roster("all"), {}};
  const auto large = drawn(pool, 12, 7);
  for (const auto& name : drawn(pool, 5, 7)) EXPECT_EQ(std::count(large.begin(), large.end(), name), 1) << name;
  EXPECT_NE(drawn(pool, 12, 8), large);
  std::vector<std::string> all;
  for (const auto& strategy : pool.listed) all.push_back(strategy.name);
  EXPECT_EQ(drawn(pool, all.size(), 3), all);  // in the pool's order
}

TEST(SampleOf, RefusesWhatThereIsNot) {
  const Pool three{roster("all_c,all_d,pavlov"), {}};
  for (const std::uint64_t count : {std::uint64_t{0}, std::uint64_t{4}, Family::most_listed + 1})
    EXPECT_THROW(sample_of(three, count, 1), UsageError) << count;
  EXPECT_THROW(sample_of({{}, {four_words()}}, 5, 1), UsageError);  // not counted: found out
  EXPECT_EQ(drawn({{}, {four_words()}}, 4, 1).size(), 4U);
}

TEST(HalfOf, DividesListsAndFamilies) {
  const Pool all{roster("classics,random(0.5)"), {four_words()}};
  const auto trained = half_of(all, Half::trained);
  const auto held_out = half_of(all, Half::held_out);
  EXPECT_EQ(trained.listed.size() + held_out.listed.size(), all.listed.size());
  for (const auto& strategy : held_out.listed) EXPECT_EQ(half_of(*strategy.machine), Half::held_out) << strategy.name;
  // per_c and per_cc play alike, and so do per_d and per_dd; all_c and all_d are held out
  EXPECT_EQ(drawn({{}, held_out.unlisted}, 4, 1), (std::vector<std::string>{"per_c", "per_d", "per_cc", "per_dd"}));
  EXPECT_THROW(sample_of({{}, trained.unlisted}, 1, 1), UsageError);
  EXPECT_EQ(half_of(trained, Half::trained).unlisted.size(), 1U);
  EXPECT_THROW(half_of(trained, Half::held_out), UsageError);  // nobody is in both
  EXPECT_THROW(half_of(Pool{roster("all_c,all_d"), {}}, Half::trained), UsageError);
  EXPECT_THROW(half_of(Pool{roster("exec:cat"), {}}, Half::trained), UsageError);
}

TEST(ListOf, RefusesWhatIsTooLarge) {
  EXPECT_EQ(list_of(pool_of(four_words())).size(), 4U);
  EXPECT_THROW(list_of({{}, {four_words()}}), UsageError);
}

}  // namespace
}  // namespace folk
