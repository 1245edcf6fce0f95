#include <folk/strategies/nearest_names.h>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace folk {
namespace {

using Names = std::vector<std::string>;

/// Candidates that are shown as they are matched.
std::vector<NameCandidate> candidates(const Names& names) {
  std::vector<NameCandidate> candidates;
  for (const auto& name : names) candidates.push_back({name, name});
  return candidates;
}

TEST(NearestNames, AreFoundByInsertedDroppedAndChangedLetters) {
  const auto names = candidates({"pavlov", "titfortat", "gradual"});
  for (const char* name : {"pavlov", "pavlo", "avlov", "pavlovv", "xpavlov", "paxlov", "pvlov"})
    EXPECT_EQ(nearest_names(name, names), Names{"pavlov"}) << name;
  EXPECT_EQ(nearest_names("tit_for_tar", names), Names{"titfortat"});
  EXPECT_EQ(nearest_names("TIT-FOR-TAT", names), Names{"titfortat"});
}

TEST(NearestNames, ComeNearestFirstAndAtMostThree) {
  const auto names = candidates({"abcdefgh", "abcdefg", "abcdef", "abcde", "abcd"});
  EXPECT_EQ(nearest_names("abcde", names), (Names{"abcde", "abcd", "abcdef"}));
  EXPECT_EQ(nearest_names("abcdefghi", names), (Names{"abcdefgh", "abcdefg", "abcdef"}));
  // Of those that are as near, the first in the alphabet.
  EXPECT_EQ(nearest_names("xa", candidates({"xd", "xc", "xb", "xe"})), (Names{"xb", "xc", "xd"}));
}

TEST(NearestNames, AreNoneWhereAllAreFar) {
  const auto names = candidates({"pavlov", "grudger"});
  EXPECT_EQ(nearest_names("zzzzzz", names), Names{});
  EXPECT_EQ(nearest_names("", names), Names{});
  EXPECT_EQ(nearest_names("", candidates({"ab", "abc"})), Names{"ab"});
  EXPECT_EQ(nearest_names("pavlov", {}), Names{});
  // Half of the letters may be wrong, and two of the shortest.
  EXPECT_EQ(nearest_names("pavxxx", names), Names{"pavlov"});
  EXPECT_EQ(nearest_names("paxxxx", names), Names{});
  EXPECT_EQ(nearest_names("xx", candidates({"ab"})), Names{"ab"});
}

TEST(NearestNames, AreShownOnceHoweverManyKeysLeadThere) {
  const std::vector<NameCandidate> names{
      {"tft", "tit_for_tat"}, {"tfft", "tit_for_tat"}, {"titfortat", "tit_for_tat"}, {"tf2t", "tit_for_two_tats"}};
  EXPECT_EQ(nearest_names("tft", names), (Names{"tit_for_tat", "tit_for_two_tats"}));
}

TEST(NearestNames, OfAHugeNameAreThoseOfItsFirstHundredBytes) {
  const std::string first(100, 'a');
  EXPECT_EQ(nearest_names(first + std::string(10'000'000, 'x'), candidates({first})), Names{first});
  EXPECT_EQ(nearest_names(std::string(10'000'000, 'x'), candidates({"pavlov"})), Names{});
}

/// Levenshtein's distance as it is defined.
std::size_t distance(std::string_view a, std::string_view b) {
  if (a.empty() || b.empty()) return a.size() + b.size();
  if (a[0] == b[0]) return distance(a.substr(1), b.substr(1));
  return 1 + std::min({distance(a.substr(1), b), distance(a, b.substr(1)), distance(a.substr(1), b.substr(1))});
}

RC_GTEST_PROP(NearestNames, AreThoseOfTheSlowDefinition, ()) {
  const auto word = rc::gen::scale(0.06, rc::gen::container<std::string>(rc::gen::element('a', 'b', 'c')));
  const std::string name = *word;
  const std::string other = *word;
  const bool near = distance(name, other) <= std::max<std::size_t>(2, name.size() / 2);
  RC_ASSERT(nearest_names(name, candidates({other})) == (near ? Names{other} : Names{}));
}

}  // namespace
}  // namespace folk
