#pragma once
// What the help texts call the values of options: --threads N, --output DIR.

#include <boost/program_options.hpp>
#include <string>

namespace folk::tools {

/// The name of an option's value in the help of a program ("mpe-train collect").
std::string value_name(const std::string& program, const std::string& option);

/// Gives each option of a program that takes a value its name.
void name_values(const std::string& program, const boost::program_options::options_description& options);

}  // namespace folk::tools
