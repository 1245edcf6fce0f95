#pragma once
// A complete class that is taken as a whole.

#include <folk/strategies/standard/memory_class.h>

#include <optional>
#include <string>

namespace folk::tools {

/// The class that a SPEC names, alone; nothing for any other SPEC. Throws UsageError.
std::optional<MemoryClass> named_class(const std::string& spec);

/// The same where it is too large for its members to be listed.
std::optional<MemoryClass> unlisted_class(const std::string& spec);

}  // namespace folk::tools
