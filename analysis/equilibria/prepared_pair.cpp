#include <folk/analysis/equilibria/prepared_pair.h>
#include <folk/games/error.h>

#include <fmt/format.h>

namespace folk {

PreparedPair::PreparedPair(PreparedMachine& first, PreparedMachine& second, unsigned horizon)
    : first_(first),
      second_(second),
      horizon_(horizon) {
  const Criterion& criterion = first.criterion();
  if (first.machine().deterministic() && second.machine().deterministic()) {
    for (PreparedMachine* machine : {&first, &second})
      if (machine->endless()) machine->table(horizon);  // refuses before the path is sought
    path_ = play_path(first.machine(), second.machine(), criterion, horizon);
  } else if (first.endless() || second.endless()) {
    throw UsageError(
        fmt::format("a machine without end in a pair that mixes, under {}: no --horizon helps, take finite:T",
                    criterion.to_string()));
  }
}

}  // namespace folk
