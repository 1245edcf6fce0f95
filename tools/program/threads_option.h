#pragma once
// The option that says how many threads work: --threads.

#include <folk/tools/program/program.h>

namespace folk::tools {

/// As many threads as --threads asks for, without it one a processor, which the ranks on one machine
/// divide; fewer, with a note on stderr, where the system
/// does not start them now.
unsigned threads_option(const po::variables_map& values, const Common& common);

}  // namespace folk::tools
