#include <folk/analysis/equilibria/prepared_pair.h>
#include <folk/games/error.h>

#include <fmt/format.h>

namespace folk {

PreparedPair::PreparedPair(PreparedMachine& first, PreparedMachine& second, unsigned horizon)
    : first_(first),
      second_(second),
      horizon_(horizon) {
  const Criterion& criterion = first.criterion();
  const Noise noise = first.rules().noise;
  if (noise == 1) throw UsageError("noise 1 turns every move over and leaves nothing to chance: expected less than 1");
  if (noise == 0 && first.machine().deterministic() && second.machine().deterministic()) {
    for (PreparedMachine* machine : {&first, &second})
      if (machine->endless()) machine->table(horizon);  // refuses before the path is sought
    path_ = play_path(first.machine(), second.machine(), criterion, horizon);
  } else if (first.endless() || second.endless()) {
    throw UsageError(fmt::format("a machine without end in a pair that {}, under {}: no --horizon helps, take finite:T",
                                 noise > 0 ? "slips" : "mixes", criterion.to_string()));
  }
}

}  // namespace folk
