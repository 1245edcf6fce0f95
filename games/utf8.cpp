#include <folk/games/utf8.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/locale/utf.hpp>  // the header alone: nothing of Boost.Locale is linked

namespace folk {
namespace {

namespace utf = boost::locale::utf;

/// What is not drawn, from - to.
constexpr std::array<std::array<utf::code_point, 2>, 13> undrawn_ranges{{{0x00, 0x1F},
                                                                         {0x7F, 0x9F},
                                                                         {0xAD, 0xAD},
                                                                         {0x061C, 0x061C},
                                                                         {0x200B, 0x200B},
                                                                         {0x200E, 0x200F},
                                                                         {0x2028, 0x202E},
                                                                         {0x2060, 0x2064},
                                                                         {0x2066, 0x2069},
                                                                         {0xE000, 0xF8FF},  // private use
                                                                         {0xFEFF, 0xFEFF},
                                                                         {0xFFFE, 0xFFFF},
                                                                         {0xF0000, 0x10FFFF}}};

utf::code_point code_point(std::string_view character) {
  const char* begin = character.data();
  return utf::utf_traits<char>::decode(begin, begin + character.size());
}

/// What stands for a character that is undrawn.
std::string escape(std::string_view character) {
  if (no_character(character)) return fmt::format("\\x{:02x}", static_cast<unsigned char>(character[0]));
  if (character == "\n") return "\\n";
  if (character == "\r") return "\\r";
  if (character == "\t") return "\\t";
  const auto code = static_cast<unsigned>(code_point(character));
  return code < 0x80 ? fmt::format("\\x{:02x}", code) : fmt::format("\\u{{{:x}}}", code);
}

/// The length of the character at the front of a text, 1 where there is none.
std::size_t first_length(std::string_view text) {
  const char* end = text.data();
  const utf::code_point found = utf::utf_traits<char>::decode(end, text.data() + text.size());
  if (found == utf::illegal || found == utf::incomplete) return 1;
  return static_cast<std::size_t>(end - text.data());
}

}  // namespace

std::vector<std::string_view> utf8_characters(std::string_view text) {
  std::vector<std::string_view> characters;
  while (!text.empty()) {
    characters.push_back(text.substr(0, first_length(text)));
    text.remove_prefix(characters.back().size());
  }
  return characters;
}

bool undrawn(std::string_view character) {
  if (character.empty()) return false;
  if (no_character(character)) return true;
  const utf::code_point code = code_point(character);
  return std::any_of(undrawn_ranges.begin(), undrawn_ranges.end(),
                     [&](const auto& range) { return code >= range[0] && code <= range[1]; });
}

std::string visible_text(std::string_view text, std::size_t most) {
  std::string shown;
  std::size_t count = 0;
  for (const std::string_view character : utf8_characters(text)) {
    if (count++ == most) return shown + "...";
    shown += undrawn(character) ? escape(character) : std::string(character);
  }
  return shown;
}

}  // namespace folk
