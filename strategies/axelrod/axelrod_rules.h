#pragma once
// The strategies of Axelrod's tournaments and of Axelrod-Python that are no line of data: those with large memories,
// counters, and records of the whole match.

#include <folk/strategies/registry.h>

namespace folk {

void add_axelrod_rules(Registry& registry);

}  // namespace folk
