// Best replies and gaps: the figures of docs/performance.md. Ratios within one run are what counts.

#include <benchmark/benchmark.h>
#include <folk/analysis/equilibria/equilibrium_check.h>
#include <folk/analysis/replies/best_reply.h>
#include <folk/games/random.h>
#include <folk/strategies/registry.h>

#include <cstdint>
#include <vector>

namespace folk {
namespace {

Automaton random_machine(std::uint64_t seed, std::uint32_t size, bool pure) {
  RandomStream random({seed, 0, 0, 0});
  const auto below = [&](std::uint32_t n) { return static_cast<std::uint32_t>(random() % n); };
  std::vector<Automaton::Node> nodes(size);
  for (auto& node : nodes) {
    node.cooperation = pure ? below(2) : random.uniform();
    for (auto& next : node.next) next = below(size);
  }
  return Automaton(std::move(nodes), 0);
}

/// The best reply to a random machine of 1,000 states: of ten machines in turn, pure or mixing.
void reply_to_1000_states(benchmark::State& state, const char* criterion, bool pure) {
  std::vector<Automaton> machines;
  for (std::uint64_t seed = 0; seed < 10; ++seed) machines.push_back(random_machine(seed, 1000, pure));
  std::size_t i = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(best_reply(machines[i++ % machines.size()], {{}, Criterion::parse(criterion)}));
}
BENCHMARK_CAPTURE(reply_to_1000_states, exact_discounted_0_99, "discounted:0.99", true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(reply_to_1000_states, mixing_discounted_0_99, "discounted:0.99", false)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(reply_to_1000_states, exact_mean, "mean", true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(reply_to_1000_states, mixing_mean, "mean", false)->Unit(benchmark::kMillisecond);

/// All gaps of all 14 x 14 pairs of finite classics, the 17 classics being the class of beliefs.
void classics_gaps(benchmark::State& state, const char* criterion) {
  const auto classics = Registry::standard().roster("classics");
  const EquilibriumQuestion question{{{}, Criterion::parse(criterion)}, classics};
  for (auto _ : state) {
    ClassReplies beliefs = class_replies(question);
    for (const Strategy& first : classics)
      for (const Strategy& second : classics)
        if (first.machine->finite() && second.machine->finite())
          benchmark::DoNotOptimize(pair_gaps(*first.machine, *second.machine, question, beliefs));
  }
}
BENCHMARK_CAPTURE(classics_gaps, discounted_0_9, "discounted:0.9")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(classics_gaps, finite_100, "finite:100")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(classics_gaps, mean, "mean")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace folk
