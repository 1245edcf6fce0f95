#pragma once
// The ecological competition of a complete class that is too large to be listed.

#include <folk/tools/program/journal.h>
#include <folk/tools/program/program.h>

#include <folk/strategies/standard/memory_class.h>

namespace folk::tools {

/// Runs it and prints what became of it. Throws UsageError where options ask for what only a listed roster has.
int evolve_class(const MemoryClass& members, const po::variables_map& values, const Common& common);

}  // namespace folk::tools
