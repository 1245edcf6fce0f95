#pragma once
// Texts as characters: names come from files and command lines, in any language or none.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace folk {

/// The characters of a text in UTF-8, one after the other. A byte that belongs to no well-formed character (Unicode,
/// table 3-7: no overlong forms, no surrogates, nothing above U+10FFFF) stands alone, and is no_character().
std::vector<std::string_view> utf8_characters(std::string_view text);

/// True for such a byte.
inline bool no_character(std::string_view part) { return part.size() == 1 && (part[0] & 0x80) != 0; }

/// True for a character (as utf8_characters gives it) that is not drawn but acted on, by a terminal or by whatever
/// splits text into lines and columns: control characters (also those from U+0080 on), separators of lines and
/// paragraphs, marks that turn the direction of what follows, marks that nobody sees (U+FEFF, which opens files, spaces
/// of no width), U+FFFE and U+FFFF, which XML has no place for; and for a byte that is no character.
bool undrawn(std::string_view character);

/// Somebody else's text as it is shown, on one line and in well-formed UTF-8: \n, \r, \t, \x1b or \u{202e} stands for a
/// character that is undrawn, \xff for a byte that is none. Everything that Folk prints and did not write itself goes
/// through this (JSON has an escape of its own, messages an excerpt()). Longer than `most` characters it ends in "...".
std::string visible_text(std::string_view text, std::size_t most = std::string_view::npos);

}  // namespace folk
