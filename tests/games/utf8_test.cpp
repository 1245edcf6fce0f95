#include <folk/games/utf8.h>
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace folk
