#include <folk/games/error.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace folk {
namespace {

TEST(Excerpt, ShowsShortTextAsItIs) { EXPECT_EQ(excerpt("tit_for_tat"), "tit_for_tat"); }

TEST(Excerpt, CutsLongText) { EXPECT_EQ(excerpt("abcdef", 3), "abc..."); }

TEST(Excerpt, HidesControlBytes) { EXPECT_EQ(excerpt(std::string_view("a\nb\0c\x1b", 6)), "a?b?c?"); }

TEST(Excerpt, HidesWhatIsNotDrawnAndBytesThatAreNoText) {
  EXPECT_EQ(excerpt("a\xC2\x9B"
                    "31m"),
            "a?31m");
  EXPECT_EQ(excerpt("\xE2\x80\xAE"
                    "gpj.exe"),
            "?gpj.exe");
  EXPECT_EQ(excerpt("caf\xE9"), "caf?");
}

TEST(Excerpt, DoesNotCutACharacterInTwo) {
  EXPECT_EQ(excerpt("a\xC3\xA9", 2), "a...");
  EXPECT_EQ(excerpt("a\xC3\xA9z", 3), "a\xC3\xA9...");
}

RC_GTEST_PROP(Excerpt, StaysOnOneLineAndShort, (const std::string& text)) {
  const std::string shown = excerpt(text, 10);
  RC_ASSERT(shown.size() <= 13U);
  for (const char c : shown) RC_ASSERT(static_cast<unsigned char>(c) >= 0x20U);
}

}  // namespace
}  // namespace folk
