#include <folk/tools/sct_train/held_out.h>

#include <fmt/format.h>
#include <folk/analysis/replies/opponent_prior.h>
#include <folk/games/error.h>
#include <folk/strategies/equivalence.h>
#include <folk/strategies/half.h>
#include <folk/strategies/names.h>

#include <memory>

namespace folk::tools {
namespace {

constexpr std::size_t most_pairs = 10'000;  // of machines without end

/// The strategy of a name in a folder; without a machine where nobody knows it.
Strategy named(const std::string& name, const TrainConfig& config, const Registry& names) {
  try {
    return names.make(name, config.payoffs);
  } catch (const Error&) {
    return {name, nullptr, nullptr};
  }
}

bool play_alike(const std::shared_ptr<const Machine>& a, const std::shared_ptr<const Machine>& b) {
  return a && b && compare(*a, *b, Sense::own_moves_its_own, most_pairs).equivalence == Equivalence::equivalent;
}

}  // namespace

std::vector<Strategy> met_in_training(const TrainConfig& config, const std::vector<Strategy>& roster,
                                      const std::set<std::string>& opponents, const Registry& names) {
  if (!config.data_is_folder() && !config.explores()) return roster;
  std::vector<Strategy> met;
  for (const auto& name : opponents)
    if (!name.empty()) met.push_back(named(name, config, names));
  return met;
}

std::vector<Strategy> held_out_roster(const TrainConfig& config, const std::vector<Strategy>& met,
                                      const Registry& names) {
  if (!config.holds_out()) return {};
  auto roster = names.roster(config.held_out, config.payoffs);
  if (config.explores() && !read_prior(names, config.met(), config.payoffs).classes.empty())
    for (const auto& strategy : roster)
      if (strategy.machine && half_of(*strategy.machine) == Half::trained)
        throw UsageError(
            fmt::format("held-out: {} is in the half of all strategies that may be trained on; hold out some of "
                        "half(SPEC;held_out)",
                        excerpt(strategy.name)));
  for (const auto& known : met)
    for (const auto& strategy : roster) {
      const bool same = same_name(strategy.name, known.name);
      if (same || play_alike(strategy.machine, known.machine))
        throw UsageError(fmt::format("held-out: {}{} is met in training; hold out strategies that are not",
                                     excerpt(strategy.name),
                                     same ? "" : fmt::format(" plays as {}, which", excerpt(known.name))));
    }
  return roster;
}

}  // namespace folk::tools
