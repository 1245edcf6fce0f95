#pragma once
// Strategies by their names.

#include <folk/strategies/registry.h>

#include <string>
#include <vector>

namespace folk::test {

inline Strategy named(const std::string& name) { return Registry::standard().make(name); }

inline std::vector<Strategy> roster(const std::string& spec) { return Registry::standard().roster(spec); }

/// Every strategy that has a name without parameters.
inline std::vector<Strategy> every_named() {
  const Registry registry = Registry::standard();
  std::vector<Strategy> strategies;
  for (const auto& description : registry.strategies())
    if (description.name.find_first_of("(<@:") == std::string::npos)
      strategies.push_back(registry.make(description.name));
  return strategies;
}

}  // namespace folk::test
