#include <folk/analysis/evolution/selection_rules.h>
#include <folk/games/error.h>

#include <fmt/format.h>

namespace folk {

std::string SelectionRules::text() const {
  const char* const name = process == Process::pairwise_comparison ? "pairwise comparison, 1 / (1 + exp(-w difference))"
                           : fitness == Fitness::linear            ? "birth-death, fitness 1 - w + w payoff"
                                                                   : "birth-death, fitness exp(w payoff)";
  return fmt::format("{}, w {}{}", name, to_short_text(intensity), meets_itself ? ", meets itself" : "");
}

void check(const SelectionRules& rules) {
  const bool linear = rules.process == Process::birth_death && rules.fitness == Fitness::linear;
  if (rules.intensity < 0 || (linear && rules.intensity > 1))
    throw UsageError(fmt::format("an intensity of {}: expected {}", to_short_text(rules.intensity),
                                 linear ? "0 to 1 for linear fitness 1 - w + w payoff" : "a number from 0 on"));
}

}  // namespace folk
