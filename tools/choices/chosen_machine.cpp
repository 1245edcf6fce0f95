#include <folk/tools/choices/chosen_machine.h>

#include <fmt/format.h>
#include <folk/games/error.h>

namespace folk::tools {

Strategy chosen_machine(const Registry& registry, const std::string& name, const Payoffs& payoffs,
                        const std::string& done_to) {
  Strategy strategy = registry.make(name, payoffs);
  require_machine(strategy, done_to);
  return strategy;
}

void require_machine(const Strategy& strategy, const std::string& done_to) {
  if (!strategy.machine)
    throw UsageError(fmt::format("{} is an opaque player: it can be played, but it has no machine that could be {}",
                                 strategy.name, done_to));
}

}  // namespace folk::tools
