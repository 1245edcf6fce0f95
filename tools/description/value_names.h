#pragma once
// What the values of options are: how help calls them (--threads N, --output DIR), and the words among which some
// choose.

#include <boost/program_options.hpp>
#include <string>
#include <vector>

namespace folk::tools {

/// The name of an option's value in the help of a program ("mpe-train collect").
std::string value_name(const std::string& program, const std::string& option);

/// The words that an option of a program takes ("ecological" of --model of ipd-evolve); none where it takes something
/// else.
std::vector<std::string> value_words(const std::string& program, const std::string& option);

/// Gives each option of a program that takes a value its name.
void name_values(const std::string& program, const boost::program_options::options_description& options);

}  // namespace folk::tools
