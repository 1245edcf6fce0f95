#pragma once
// How journals are sealed: the title of their kind first, a signature of all before it last.

#include <cstdint>
#include <string>
#include <string_view>

namespace folk {

/// The signature that seals a text.
std::uint64_t seal_of(std::string_view text);

/// The text, whose first line is a title, with its seal as last line.
std::string sealed(std::string text);

/// What stands between title and seal. Throws InputFileError, naming `source`, where the title is another or the seal
/// is not that of the text.
std::string_view unsealed(std::string_view text, std::string_view title, const std::string& source);

/// Throws the InputFileError of a journal that is whole but belongs to other work.
[[noreturn]] void refuse_other_run(const std::string& source);

}  // namespace folk
