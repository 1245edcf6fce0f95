#pragma once
// The one machine that a user names on a command line.

#include <folk/strategies/registry.h>

#include <string>

namespace folk::tools {

/// The strategy of this name, which has a machine. Throws what Registry::make throws, and UsageError for an opaque
/// player, which can be played but not `done_to` ("drawn", "compared").
Strategy chosen_machine(const Registry& registry, const std::string& name, const Payoffs& payoffs,
                        const std::string& done_to);

/// Throws UsageError for an opaque player.
void require_machine(const Strategy& strategy, const std::string& done_to);

}  // namespace folk::tools
