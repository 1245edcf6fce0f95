#include <folk/games/utf8.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace folk {
namespace {

using Parts = std::vector<std::string_view>;

/// One row of table 3-7 of the Unicode standard: the ranges of the bytes.
using Row = std::vector<std::pair<unsigned, unsigned>>;
const std::array<Row, 9> well_formed{{{{0x00, 0x7F}},
                                      {{0xC2, 0xDF}, {0x80, 0xBF}},
                                      {{0xE0, 0xE0}, {0xA0, 0xBF}, {0x80, 0xBF}},
                                      {{0xE1, 0xEC}, {0x80, 0xBF}, {0x80, 0xBF}},
                                      {{0xED, 0xED}, {0x80, 0x9F}, {0x80, 0xBF}},
                                      {{0xEE, 0xEF}, {0x80, 0xBF}, {0x80, 0xBF}},
                                      {{0xF0, 0xF0}, {0x90, 0xBF}, {0x80, 0xBF}, {0x80, 0xBF}},
                                      {{0xF1, 0xF3}, {0x80, 0xBF}, {0x80, 0xBF}, {0x80, 0xBF}},
                                      {{0xF4, 0xF4}, {0x80, 0x8F}, {0x80, 0xBF}, {0x80, 0xBF}}}};

bool is_row(const Row& row, std::string_view text) {
  if (text.size() < row.size()) return false;
  for (std::size_t i = 0; i < row.size(); ++i) {
    const unsigned byte = static_cast<unsigned char>(text[i]);
    if (byte < row[i].first || byte > row[i].second) return false;
  }
  return true;
}

/// By the table.
std::size_t first_length(std::string_view text) {
  const auto row =
      std::find_if(well_formed.begin(), well_formed.end(), [&](const Row& each) { return is_row(each, text); });
  return row == well_formed.end() ? 1 : row->size();
}

TEST(Utf8, CharactersAreThoseOfTheStandardsTable) {
  // Every first byte, and what lies at the edges of the ranges behind it.
  constexpr std::array<unsigned, 10> second_edges{0x00, 0x7F, 0x80, 0x8F, 0x90, 0x9F, 0xA0, 0xBF, 0xC0, 0xFF};
  constexpr std::array<unsigned, 4> edges{0x7F, 0x80, 0xBF, 0xC0};
  for (unsigned first = 0; first < 256; ++first)
    for (const unsigned second : second_edges)
      for (const unsigned third : edges)
        for (const unsigned fourth : edges) {
          std::string text;
          for (const unsigned byte : {first, second, third, fourth}) text += static_cast<char>(byte);
          for (std::size_t length = 1; length <= 4; ++length) {
            const std::string_view front = std::string_view(text).substr(0, length);
            const auto parts = utf8_characters(front);
            ASSERT_EQ(parts[0].size(), first_length(front)) << first << " " << second << " " << third << " " << fourth;
            ASSERT_EQ(no_character(parts[0]), first >= 0x80 && parts[0].size() == 1);
          }
        }
}

TEST(Utf8, PartsAreTheWholeText) {
  EXPECT_EQ(utf8_characters(""), Parts{});
  EXPECT_EQ(utf8_characters("a±…😀"), (Parts{"a", "±", "…", "😀"}));
  EXPECT_EQ(utf8_characters(std::string_view("\0b", 2)), (Parts{std::string_view("\0", 1), "b"}));
  // A stray byte hides nothing that follows it, and a character that is cut off falls apart.
  EXPECT_EQ(utf8_characters("\xE2é\xC3"), (Parts{"\xE2", "é", "\xC3"}));
  EXPECT_EQ(utf8_characters("\xE2\x80"), (Parts{"\xE2", "\x80"}));
}

TEST(Utf8, WhatIsNotDrawnIsShownByAnEscape) {
  EXPECT_EQ(visible_text("tit_for_tat, ±1 … 😀 \\ \""), "tit_for_tat, ±1 … 😀 \\ \"");
  EXPECT_EQ(visible_text("a\nb\r\tc\x1b[31m\x7f"), R"(a\nb\r\tc\x1b[31m\x7f)");
  EXPECT_EQ(visible_text(std::string_view("\0", 1)), R"(\x00)");
  // The terminal's other CSI, next line, the separators of lines and paragraphs, marks of direction.
  EXPECT_EQ(visible_text("\xC2\x9B\xC2\x85\xE2\x80\xA8\xE2\x80\xA9\xE2\x80\xAE\xE2\x81\xA6"),
            R"(\u{9b}\u{85}\u{2028}\u{2029}\u{202e}\u{2066})");
  EXPECT_EQ(visible_text("caf\xE9 \xE2\x82"), R"(caf\xe9 \xe2\x82)");
  EXPECT_EQ(visible_text("3\xEF\xBB\xBF \xE2\x80\x8B\xC2\xAD\xE2\x80\x8D"), "3\\u{feff} \\u{200b}\\u{ad}\xE2\x80\x8D");
  EXPECT_EQ(visible_text("\xEF\xBF\xBE\xEF\xBF\xBD"), "\\u{fffe}\xEF\xBF\xBD");
  // For private use: what is drawn there, if anything, only a font knows.
  EXPECT_EQ(visible_text("\xEE\x80\x80\xEF\xA3\xBF\xEF\xA4\x80\xF3\xB0\x80\x80"),
            "\\u{e000}\\u{f8ff}\xEF\xA4\x80\\u{f0000}");
}

TEST(Utf8, VisibleTextIsCutBetweenCharacters) {
  EXPECT_EQ(visible_text("äöü", 3), "äöü");
  EXPECT_EQ(visible_text("äöü", 2), "äö...");
  EXPECT_EQ(visible_text("a\nb", 2), R"(a\n...)");
  EXPECT_EQ(visible_text("a", 0), "...");
}

RC_GTEST_PROP(Utf8, VisibleTextIsDrawnAndSoIsItsOwn, (const std::string& text)) {
  const std::string shown = visible_text(text);
  for (const auto part : utf8_characters(shown)) RC_ASSERT(!undrawn(part));
  RC_ASSERT(visible_text(shown) == shown);
}

}  // namespace
}  // namespace folk
