#include <folk/analysis/play/markov_play.h>
#include <folk/analysis/replies/memory_one_payoff.h>
#include <folk/games/error.h>
#include <folk/strategies/memory_one.h>

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace folk {

Automaton MemoryOne::machine() const { return memory_one(opening == Move::C ? 1 : 0, after); }

WeightedOpponents::WeightedOpponents(std::vector<WeightedOpponent> members, const MatchRules& rules)
    : members_(std::move(members)),
      rules_(rules),
      numbers_(rules.payoffs.numbers()) {
  if (members_.empty()) throw UsageError("a population of nobody has no best reply");
  double total = 0;
  for (const WeightedOpponent& member : members_) {
    if (!(member.weight > 0 && std::isfinite(member.weight)))
      throw UsageError(fmt::format("weight {} of an opponent: expected a positive number", member.weight));
    total += member.weight;
  }
  for (WeightedOpponent& member : members_) member.weight /= total;
  // A strategy that mixes after every outcome reaches all joint states that any does.
  for (std::size_t i = 0; i < size(); ++i) payoff(memory_one(0.5, {0.5, 0.5, 0.5, 0.5}), i);
}

double WeightedOpponents::payoff(const Automaton& strategy, std::size_t member) const {
  const auto pair = play_markov(strategy, members_[member].machine, rules_.noise, rules_.criterion);
  if (!pair)
    throw UsageError(fmt::format("an opponent of {} states is too large for a search under {}",
                                 members_[member].machine.size(), rules_.criterion.to_string()));
  double sum = 0;
  for (std::size_t o = 0; o < 4; ++o) sum += numbers_[o] * pair->weights[o];
  return sum;
}

double WeightedOpponents::payoff(const MemoryOne& strategy, std::size_t member) const {
  return payoff(strategy.machine(), member);
}

double WeightedOpponents::payoff(const MemoryOne& strategy) const {
  const Automaton machine = strategy.machine();
  double sum = 0;
  for (std::size_t i = 0; i < size(); ++i) sum += members_[i].weight * payoff(machine, i);
  return sum;
}

}  // namespace folk
