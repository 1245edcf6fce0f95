#include <folk/analysis/replies/opponent_prior.h>
#include <folk/games/error.h>
#include <folk/games/rational.h>
#include <folk/strategies/names.h>

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>

namespace folk {
namespace {

constexpr double least_weight = 1e-6;
constexpr double most_weight = 1e6;

struct WeightedItem {
  std::optional<double> weight;
  std::string item;
};

/// "3*sct2025" in its parts. Strategies' names hold no '*', but programs and files may.
WeightedItem weighted_item(const std::string& text) {
  const auto star = text.find('*');
  if (star == std::string::npos || text.find_first_of("([\"@:") < star) return {std::nullopt, text};
  const auto number = trimmed(std::string_view(text).substr(0, star));
  const double weight = parse_number(number, fmt::format("weight in '{}'", excerpt(text)), least_weight, most_weight);
  return {weight, std::string(trimmed(std::string_view(text).substr(star + 1)))};
}

void add_known(OpponentPrior& prior, const std::vector<Strategy>& roster, double weight_of_each) {
  for (const auto& strategy : roster) prior.known.push_back({strategy, weight_of_each});
}

void require_machines(const OpponentPrior& prior) {
  for (const auto& [strategy, weight] : prior.known)
    if (!strategy.machine)
      throw UsageError(fmt::format("{} is an opaque player: only machines can be learnt about", strategy.name));
}

}  // namespace

OpponentPrior equal_prior(const std::vector<Strategy>& roster) {
  if (roster.empty()) throw UsageError("Bayesian play needs a roster of at least one strategy");
  OpponentPrior prior;
  add_known(prior, roster, 1);
  require_machines(prior);
  return prior;
}

OpponentPrior read_prior(const Registry& registry, std::string_view spec, const Payoffs& payoffs) {
  OpponentPrior prior = read_weighted_roster(registry, spec, payoffs);
  require_machines(prior);
  return prior;
}

OpponentPrior read_weighted_roster(const Registry& registry, std::string_view spec, const Payoffs& payoffs) {
  OpponentPrior prior;
  std::string rest;  // what has no weight is read as a roster is: nobody is there twice
  for (const auto& text : split_list(spec)) {
    const auto [weight, item] = weighted_item(text);
    if (const auto members = MemoryClass::parse(item)) {
      prior.classes.push_back({*members, weight.value_or(std::ldexp(1.0, static_cast<int>(members->genes())))});
    } else if (weight) {
      const auto roster = registry.roster(item, payoffs);
      add_known(prior, roster, *weight / static_cast<double>(roster.size()));
    } else {
      rest += (rest.empty() ? "" : ",") + item;
    }
  }
  if (!rest.empty() || (prior.known.empty() && prior.classes.empty()))
    add_known(prior, registry.roster(rest.empty() ? spec : rest, payoffs), 1);
  return prior;
}

bool has_weights(std::string_view spec) {
  for (const auto& text : split_list(spec))
    if (weighted_item(text).weight) return true;
  return false;
}

}  // namespace folk
