#pragma once
// The standard input, for a file of the name "-".

#include <string>
#include <string_view>

namespace folk::tools {

/// All that comes on it, up to largest_text_file bytes. There is one, and it can be read once: throws UsageError when
/// it was read before, or several ranks share the work; `asked_by` ("--game -") is what that message calls this
/// reading. Throws InputFileError when it is larger or cannot be read.
std::string read_standard_input(std::string_view asked_by);

/// The text of a file; of "-" the standard input. Throws what read_text_file and read_standard_input throw.
std::string read_file_or_input(const std::string& file, std::string_view asked_by);

}  // namespace folk::tools
