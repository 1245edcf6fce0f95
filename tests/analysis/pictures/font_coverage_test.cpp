#include <folk/analysis/pictures/font_coverage.h>

#include <gtest/gtest.h>

namespace folk {
namespace {

TEST(FontCoverage, WhatNoFontHasIsAQuestionMark) {
  EXPECT_EQ(with_covered_characters("a日β", "20-7e 3b1-3c9\n20-7e\n"), "a?β");
  EXPECT_EQ(with_covered_characters("日本", "65e5\n672c-672d\n"), "日本");
  EXPECT_EQ(with_covered_characters("😀", "1f600"), "😀");
  EXPECT_EQ(with_covered_characters("😀…", ""), "??");
}

TEST(FontCoverage, LatinLettersAreInEveryFont) {
  EXPECT_EQ(with_covered_characters("Überstürzt · 100 % ÿ", ""), "Überstürzt · 100 % ÿ");
}

TEST(FontCoverage, AStrangeListDoesNoHarm) {
  EXPECT_EQ(with_covered_characters("β", "x-y  - 3b1- -3b2\n\n3b2"), "β");
  EXPECT_EQ(with_covered_characters("α", "ffffffffff 3b2-3b0"), "?");
}

}  // namespace
}  // namespace folk
