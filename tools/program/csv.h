#pragma once
// Fields of comma-separated values.

#include <string>

namespace folk::tools {

/// A field as RFC 4180 has it: in quotes where it holds a comma, a quote or a line end.
inline std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

}  // namespace folk::tools
