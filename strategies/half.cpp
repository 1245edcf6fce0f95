#include <folk/games/outcome.h>
#include <folk/games/random.h>
#include <folk/strategies/automaton.h>
#include <folk/strategies/half.h>

#include <array>
#include <bit>
#include <vector>

namespace folk {
namespace {

/// Philox over the five words; the last word of either step keeps the two apart.
std::uint64_t mix(double cooperation, const std::array<std::uint64_t, 4>& after) {
  const auto bits = std::bit_cast<std::uint64_t>(cooperation + 0.0);  // -0.0 is 0.0
  const std::uint64_t first = RandomStream({bits, after[0], after[1], 1})();
  return RandomStream({first, after[2], after[3], 2})();
}

}  // namespace

std::uint64_t behaviour_key(const Machine& machine) {
  constexpr Sense sense = Sense::own_moves_its_own;
  // What lies beyond these rounds gets keys too, which do not reach the start.
  const Automaton rounds = unroll(machine, sense, half_rounds);
  std::vector<std::uint64_t> keys(rounds.size(), 0);
  std::vector<std::uint64_t> longer(rounds.size());
  for (unsigned round = 0; round < half_rounds; ++round) {
    for (std::size_t s = 0; s < rounds.size(); ++s) {
      const auto& [cooperation, next] = rounds.nodes()[s];
      std::array<std::uint64_t, 4> after{};
      for (const Outcome outcome : all_outcomes)
        if (possible(cooperation, outcome, sense)) after[outcome.index()] = keys[next[outcome.index()]];
      longer[s] = mix(cooperation, after);
    }
    keys.swap(longer);
  }
  return keys[rounds.start()];
}

Half half_of(const Machine& machine) { return behaviour_key(machine) % 2 == 0 ? Half::trained : Half::held_out; }

}  // namespace folk
