#pragma once
// What may follow on a command line that is being typed. The scripts of cmake/completion ask the program itself, so
// that they hold no table of their own: what it offers is what it takes.

#include <folk/tools/description/description.h>

#include <string>
#include <string_view>
#include <vector>

namespace folk::tools {

/// The answer to "--complete SHELL LINE [BREAKS]": a candidate a line, as the shell (bash, zsh, fish) wants it. LINE is
/// the command line up to the cursor. A candidate after which a new word begins ends in a blank.
///
/// bash: quoted for the quotation mark that is open, without what stands before the last of the BREAKS
/// (COMP_WORDBREAKS), which bash leaves as it is. zsh, fish: not quoted, which they do; after a tab what it means.
std::string completions(const Program& program, const std::vector<std::string>& formats, std::string_view shell,
                        std::string_view line, std::string_view breaks);

/// The second word of a command line, where a third one has begun: the verb that what follows belongs to.
std::string verb_of_line(std::string_view line);

}  // namespace folk::tools
