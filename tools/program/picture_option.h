#pragma once
// The option that asks for pictures beside the files of --output: --plot.

#include <folk/tools/program/program.h>

#include <optional>
#include <string>

namespace folk::tools {

/// svg, png or pdf as --plot says, or nothing where it is not given. Throws UsageError for another word, and without a
/// folder for the pictures.
std::optional<std::string> picture_extension(const po::variables_map& values);

}  // namespace folk::tools
