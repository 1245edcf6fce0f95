#pragma once
// A program's description as a page for man.

#include <folk/tools/description/description.h>

#include <string>

namespace folk::tools {

/// The page, in the macros of man(7): the data of the help text, with the files and the variables that all programs
/// read.
std::string man_page(const Program& program);

}  // namespace folk::tools
