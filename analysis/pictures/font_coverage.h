#pragma once
// Which characters some font of this machine can draw.

#include <string>
#include <string_view>

namespace folk {

/// A text in UTF-8 with a question mark for each character beyond U+024F that is in none of the `charsets`: a line a
/// font, of hexadecimal numbers and ranges ("20-7e a0 2026"), as fc-list writes them.
std::string with_covered_characters(std::string_view text, std::string_view charsets);

/// The same by the fonts that fontconfig knows here; unchanged where it cannot be asked. gnuplot's png and pdf
/// terminals draw a character without a font as black shapes over the whole picture.
std::string with_drawable_characters(const std::string& text);

}  // namespace folk
