#pragma once
// What the help texts call the values of options: --threads N, --output DIR.

#include <folk/tools/program/program.h>

#include <string>

namespace folk::tools {

/// The name of an option's value in the help of a program ("mpe-train collect").
std::string value_name(const std::string& program, const std::string& option);

/// Gives each option of a program that takes a value its name.
void name_values(const Program& program);

}  // namespace folk::tools
