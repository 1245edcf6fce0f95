#pragma once
// Strategies by their names.

#include <folk/strategies/registry.h>

#include <string>
#include <vector>

namespace folk::test {

inline Strategy named(const std::string& name) { return Registry::standard().make(name); }

inline std::vector<Strategy> roster(const std::string& spec) { return Registry::standard().roster(spec); }

}  // namespace folk::test
