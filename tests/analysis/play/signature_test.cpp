#include <folk/analysis/play/signature.h>
#include <gtest/gtest.h>

#include <cstdint>

namespace folk {
namespace {

/// Of the first multiples of an odd number.
std::uint64_t of_words(std::uint64_t count) {
  Signature signature;
  for (std::uint64_t i = 0; i < count; ++i) signature.add(i * 0x9E3779B97F4A7C15U);
  return signature.value();
}

// xxhsum -H3 of the same bytes in a file: nothing, a word, some, a whole block, a word more, many blocks.
TEST(Signature, IsXxh3OfTheLittleEndianWords) {
  EXPECT_EQ(of_words(0), 0x2d06800538d394c2U);
  EXPECT_EQ(of_words(1), 0xc77b3abb6f87acd9U);
  EXPECT_EQ(of_words(3), 0xdb2228c323f81d33U);
  EXPECT_EQ(of_words(64), 0x193276c9ab897b0eU);
  EXPECT_EQ(of_words(65), 0x4b2396e700f02f33U);
  EXPECT_EQ(of_words(512), 0xea4b11a1dda8a78bU);
}

TEST(Signature, OfTextsNumbersAndWordsTogether) {
  Signature signature;
  signature.add(std::uint64_t{3});
  signature.add("tit_for_tat");
  signature.add("");
  signature.add(-1.5);
  signature.add(-0.0);
  signature.add(std::uint64_t{7});
  EXPECT_EQ(signature.value(), 0x7888fbd0a6989b14U);  // xxhsum -H3, each text behind its length
}

TEST(Signature, TellsWhereATextEnds) {
  Signature one;
  one.add("ab");
  one.add("c");
  Signature other;
  other.add("a");
  other.add("bc");
  EXPECT_NE(one.value(), other.value());
}

TEST(Signature, GoesOnAfterItWasAsked) {
  Signature signature;
  for (std::uint64_t i = 0; i < 65; ++i) {
    EXPECT_EQ(signature.value(), of_words(i)) << i;
    signature.add(i * 0x9E3779B97F4A7C15U);
  }
}

}  // namespace
}  // namespace folk
