#pragma once
// Strategies as they are typed: the last item of a SPEC, wherever in brackets it stands.

#include <folk/tools/description/candidate.h>

#include <folk/strategies/registry.h>

#include <string_view>
#include <vector>

namespace folk::tools {

/// What the SPEC may become: names (others than the first of a strategy once they are begun), rosters, families with
/// what they take, files.
std::vector<Candidate> spec_candidates(const Registry& registry, std::string_view spec);

/// The literal beginning of a name of the registry's: "gtft(" of "gtft(q)", "@" of "@FILE", all of "pavlov".
std::string_view literal_part(std::string_view name);

}  // namespace folk::tools
