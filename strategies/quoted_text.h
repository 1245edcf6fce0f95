#pragma once
// Text in double quotes, as commands and files stand in a roster: exec:"CMD", sct:"FILE".

#include <cstddef>
#include <string>
#include <string_view>

namespace folk {

/// What stands between double quotes, \" and \\ read as " and \; a text without quotes as it is.
inline std::string unquoted(std::string_view text) {
  if (text.size() < 2 || text.front() != '"' || text.back() != '"') return std::string(text);
  std::string inside;
  for (std::size_t i = 1; i + 1 < text.size(); ++i) {
    if (text[i] == '\\' && i + 2 < text.size() && (text[i + 1] == '"' || text[i + 1] == '\\')) ++i;
    inside += text[i];
  }
  return inside;
}

}  // namespace folk
