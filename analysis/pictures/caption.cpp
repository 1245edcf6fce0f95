#include <folk/analysis/pictures/caption.h>
#include <folk/games/utf8.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace folk {
namespace {

constexpr std::string_view separator = " · ";
constexpr std::size_t longest_part = 100;

std::vector<std::string> parts_of(const Caption& caption) {
  std::vector<std::string> parts;
  for (const auto* text : {&caption.game, &caption.criterion})
    if (!text->empty()) parts.push_back(visible_text(*text, longest_part));
  if (caption.noise != 0) parts.push_back(fmt::format("noise {}", caption.noise));
  parts.emplace_back("Folk " FOLK_VERSION);
  return parts;
}

}  // namespace

std::string caption_text(const Caption& caption) { return fmt::format("{}", fmt::join(parts_of(caption), separator)); }

std::vector<std::string> caption_lines(const Caption& caption, std::size_t most) {
  std::vector<std::string> lines;
  std::size_t length = 0;
  for (const auto& part : parts_of(caption)) {
    const std::size_t more = utf8_characters(part).size();
    if (lines.empty() || length + 3 + more > most) {
      lines.push_back(part);
      length = more;
    } else {
      lines.back() += std::string(separator) + part;
      length += 3 + more;
    }
  }
  return lines;
}

}  // namespace folk
