#pragma once
// Texts as characters: names come from files and command lines, in any language or none.

#include <string_view>
#include <vector>

namespace folk {

/// The characters of a text in UTF-8, one after the other. A byte that belongs to no well-formed character (Unicode,
/// table 3-7: no overlong forms, no surrogates, nothing above U+10FFFF) stands alone, and is no_character().
std::vector<std::string_view> utf8_characters(std::string_view text);

/// True for such a byte.
inline bool no_character(std::string_view part) { return part.size() == 1 && (part[0] & 0x80) != 0; }

}  // namespace folk
