// Equilibrium checks: the figures of docs/performance.md. Ratios within one run are what counts: machines are noisy.

#include <benchmark/benchmark.h>
#include <folk/analysis/thresholds/thresholds.h>
#include <folk/strategies/registry.h>

#include <vector>

namespace folk {
namespace {

std::vector<Automaton> finite_classics() {
  std::vector<Automaton> machines;
  for (const Strategy& strategy : Registry::standard().roster("classics"))
    if (strategy.machine && strategy.machine->finite() && strategy.machine->deterministic())
      machines.push_back(*tabulate(*strategy.machine, Sense::any_own_moves));
  return machines;
}

/// The exact threshold sets of all three notions for all 14 x 14 pairs of finite classics.
void classics_thresholds(benchmark::State& state) {
  const auto machines = finite_classics();
  for (auto _ : state)
    for (const Automaton& first : machines)
      for (const Automaton& second : machines) benchmark::DoNotOptimize(thresholds(first, second, {}));
}
BENCHMARK(classics_thresholds)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace folk
