#include <folk/games/error.h>

#include <fmt/format.h>

namespace folk {

std::string excerpt(std::string_view text, std::size_t most) {
  std::size_t length = text.size();
  if (length > most) {
    length = most;
    // Do not cut a UTF-8 character in two: its later bytes are 10xxxxxx.
    while (length > 0 && (static_cast<unsigned char>(text[length]) & 0xC0U) == 0x80U) --length;
  }
  std::string shown(text.substr(0, length));
  for (char& c : shown)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = '?';
  return length < text.size() ? shown + "..." : shown;
}

void refuse_file(std::string_view file, std::string_view why) {
  throw InputFileError(fmt::format("{}: {}", excerpt(file, 1000), why));
}

}  // namespace folk
