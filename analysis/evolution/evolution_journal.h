#pragma once
// The journal of an evolution: a text from which it goes on as if it had never stopped.

#include <folk/analysis/evolution/evolution.h>
#include <folk/analysis/evolution/simulated_fixation.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace folk {

/// No journal is larger than this.
inline constexpr std::size_t largest_journal = std::size_t{512} << 20U;

// A journal carries the `identity` of what it belongs to and a signature of itself. Reading throws InputFileError,
// naming `source`, where the text is no whole journal, and where it belongs to something else.

std::string journal_text(const EvolutionState& state, std::uint64_t identity);

/// `strategies`: of how many the populations are.
EvolutionState read_evolution_journal(std::string_view text, const std::string& source, std::uint64_t identity,
                                      std::size_t strategies);

std::string journal_text(const FixationCounts& counts, std::uint64_t identity);
FixationCounts read_fixation_journal(std::string_view text, const std::string& source, std::uint64_t identity,
                                     std::size_t strategies);

}  // namespace folk
