#pragma once
// An evolution that is run with a journal.

#include <folk/tools/program/journal.h>
#include <folk/tools/program/program.h>

#include <folk/analysis/evolution/evolution.h>

#include <cstdint>

namespace folk::tools {

/// The file of --journal, or none. Throws EnvironmentError.
Journal journal_option(const po::variables_map& values);

/// Goes on from what the journal holds up to `generations`, and keeps it up to date. Throws UsageError where it is
/// further, EnvironmentError when it was interrupted, InputFileError for a journal of other work.
void run_with_journal(Evolution& evolution, std::uint64_t generations, Journal& journal, std::uint64_t identity,
                      std::size_t strategies, const Common& common);
}  // namespace folk::tools
