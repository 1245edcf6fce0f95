#pragma once
// Fields of comma-separated values.

#include <folk/games/utf8.h>

#include <string>

namespace folk::tools {

/// A field as RFC 4180 has it: in quotes where it holds a comma or a quote. It is visible_text, so that a record stays
/// one line and the table well-formed UTF-8, whatever a name holds.
inline std::string csv_field(const std::string& text) {
  const std::string shown = visible_text(text);
  if (shown.find_first_of(",\"") == std::string::npos) return shown;
  std::string out = "\"";
  for (const char c : shown) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

}  // namespace folk::tools
