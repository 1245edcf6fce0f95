#include <folk/analysis/pictures/font_coverage.h>
#include <folk/analysis/pictures/render.h>
#include <folk/games/utf8.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <map>
#include <optional>

namespace folk {
namespace {

/// Latin letters with all their accents: every usual font has them.
constexpr std::uint32_t last_of_every_font = 0x24f;

std::uint32_t code_point(std::string_view character) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(character[i])); };
  if (character.size() == 1) return byte(0);
  std::uint32_t code = byte(0) & (0xffU >> (character.size() + 1));
  for (std::size_t i = 1; i < character.size(); ++i) code = (code << 6U) | (byte(i) & 0x3fU);
  return code;
}

/// The first and the last of a range, "41-5a" or "2026".
std::optional<std::pair<std::uint32_t, std::uint32_t>> range_of(std::string_view word) {
  std::uint32_t first = 0;
  std::uint32_t last = 0;
  const char* const end = word.data() + word.size();
  const auto [middle, error] = std::from_chars(word.data(), end, first, 16);
  if (error != std::errc()) return std::nullopt;
  if (middle == end) return std::pair(first, first);
  const auto [rest, second] = std::from_chars(middle + 1, end, last, 16);
  if (*middle != '-' || second != std::errc() || rest != end) return std::nullopt;
  return std::pair(first, last);
}

/// Calls `take` with each range of all fonts.
template <class Take>
void for_each_range(std::string_view charsets, Take take) {
  while (!charsets.empty()) {
    const auto end = std::min(charsets.find_first_of(" \n"), charsets.size());
    if (const auto range = range_of(charsets.substr(0, end))) take(range->first, range->second);
    charsets.remove_prefix(std::min(end + 1, charsets.size()));
  }
}

bool needs_a_look(std::string_view character) {
  return character.size() > 1 && code_point(character) > last_of_every_font;
}

}  // namespace

std::string with_covered_characters(std::string_view text, std::string_view charsets) {
  const auto characters = utf8_characters(text);
  std::map<std::uint32_t, bool> covered;
  for (const auto character : characters)
    if (needs_a_look(character)) covered.emplace(code_point(character), false);
  for_each_range(charsets, [&](std::uint32_t first, std::uint32_t last) {
    for (auto found = covered.lower_bound(first); found != covered.end() && found->first <= last; ++found)
      found->second = true;
  });
  std::string out;
  for (const auto character : characters)
    if (needs_a_look(character) && !covered[code_point(character)])
      out += '?';
    else
      out += character;
  return out;
}

std::string with_drawable_characters(const std::string& text) {
  const auto characters = utf8_characters(text);
  if (std::none_of(characters.begin(), characters.end(), needs_a_look)) return text;
  try {
    return with_covered_characters(text, run_renderer({"fc-list", "-f", "%{charset}\n"}, "", "fontconfig"));
  } catch (const EnvironmentError&) {
    return text;
  }
}

}  // namespace folk
