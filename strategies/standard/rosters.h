#pragma once
// The rosters of the literature.

#include <folk/strategies/registry.h>

namespace folk {

/// The classics, and "all": what is registered at this time.
void add_rosters(Registry& registry);

/// Axelrod's first tournament, Stewart and Plotkin's, and Axelrod-Python's strategies.
void add_library_rosters(Registry& registry);

}  // namespace folk
