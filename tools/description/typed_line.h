#pragma once
// A command line while it is typed, as a shell will read it.

#include <string>
#include <string_view>
#include <vector>

namespace folk::tools {

/// The words up to the cursor without their quotes; the last one is still being typed, and may be empty.
struct TypedLine {
  std::vector<std::string> words;
  char quote = '\0';            ///< the quotation mark in which the last word stands still open
  std::string last_as_typed{};  ///< the last word with its quotes
};

/// Quotation marks and backslashes as in bash, zsh and fish, whose rules for words differ in what nobody types here.
TypedLine typed_line(std::string_view line);

}  // namespace folk::tools
