#pragma once
// Families of strategies by their parameters.

#include <folk/strategies/registry.h>

namespace folk {

void add_families(Registry& registry);

}  // namespace folk
