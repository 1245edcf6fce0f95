#include <folk/analysis/play/criterion_table.h>
#include <folk/games/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

namespace folk {

Automaton table_for(const Machine& machine, const Criterion& criterion, Sense sense, unsigned horizon) {
  if (criterion.is_finite()) {
    // No machine stays within the limit of states for more rounds than `unsigned` holds unless it closes.
    constexpr std::uint64_t most = std::numeric_limits<unsigned>::max() - 1;
    return unroll(machine, sense, static_cast<unsigned>(std::min(criterion.rounds(), most)));
  }
  if (machine.finite()) {
    if (auto table = tabulate(machine, sense)) return *std::move(table);
    if (horizon == 0)
      throw UsageError(fmt::format("a machine of more than {} states: give a --horizon of rounds", 1U << 20U));
  }
  if (criterion.kind() == Criterion::Kind::mean)
    throw UsageError("a machine without end has no exact mean: take finite:T or discounted:d");
  if (horizon == 0)
    throw UsageError(fmt::format("a machine without end under {}: give a --horizon of rounds, or take finite:T",
                                 criterion.to_string()));
  return unroll(machine, sense, horizon);
}

}  // namespace folk
