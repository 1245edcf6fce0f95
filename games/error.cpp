#include <folk/games/error.h>
#include <folk/games/utf8.h>

#include <fmt/format.h>

namespace folk {

std::string excerpt(std::string_view text, std::size_t most) {
  std::size_t length = text.size();
  if (length > most) {
    length = most;
    // Do not cut a UTF-8 character in two: its later bytes are 10xxxxxx.
    while (length > 0 && (static_cast<unsigned char>(text[length]) & 0xC0U) == 0x80U) --length;
  }
  std::string shown;
  for (const std::string_view character : utf8_characters(text.substr(0, length)))
    shown += undrawn(character) ? "?" : std::string(character);
  return length < text.size() ? shown + "..." : shown;
}

void refuse_file(std::string_view file, std::string_view why) {
  throw InputFileError(fmt::format("{}: {}", excerpt(file, 1000), why));
}

}  // namespace folk
