#include <folk/tools/sct_train/held_out.h>

#include <fmt/format.h>
#include <folk/games/error.h>
#include <folk/strategies/equivalence.h>
#include <folk/strategies/names.h>

#include <optional>

namespace folk::tools {
namespace {

constexpr std::size_t most_pairs = 10'000;  // of machines without end

/// The machine of a name that training met; null for players without one and names from elsewhere.
std::shared_ptr<const Machine> machine_named(const std::string& name, const TrainConfig& config,
                                             const Registry& names) {
  try {
    return names.make(name, config.payoffs).machine;
  } catch (const Error&) {
    return nullptr;
  }
}

bool play_alike(const std::shared_ptr<const Machine>& a, const std::shared_ptr<const Machine>& b) {
  return a && b && compare(*a, *b, Sense::own_moves_its_own, most_pairs).equivalence == Equivalence::equivalent;
}

}  // namespace

std::vector<Strategy> held_out_roster(const TrainConfig& config, const Registry& names,
                                      const std::set<std::string>& met) {
  if (!config.holds_out()) return {};
  auto roster = names.roster(config.held_out, config.payoffs);
  for (const auto& name : met) {
    const auto machine = machine_named(name, config, names);
    for (const auto& strategy : roster) {
      const bool same = same_name(strategy.name, name);
      if (same || play_alike(strategy.machine, machine))
        throw UsageError(fmt::format("held-out: {}{} is met in training; hold out strategies that are not",
                                     excerpt(strategy.name),
                                     same ? "" : fmt::format(" plays as {}, which", excerpt(name))));
    }
  }
  return roster;
}

}  // namespace folk::tools
