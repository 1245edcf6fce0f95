#pragma once
// Whether a text has a part.

#include <string>
#include <string_view>

namespace folk::test {

inline bool has(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

}  // namespace folk::test
