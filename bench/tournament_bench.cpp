// The figures of docs/performance.md. Ratios within one run are what counts: machines are noisy.

#include <benchmark/benchmark.h>
#include <folk/analysis/play/cycle_table.h>
#include <folk/analysis/play/deterministic_play.h>
#include <folk/analysis/tournament/tournament.h>
#include <folk/games/outcome.h>
#include <folk/strategies/registry.h>

namespace folk {
namespace {

TournamentSettings over(std::uint64_t rounds) {
  TournamentSettings settings;
  settings.criterion = Criterion::finite(rounds);
  return settings;
}

/// Score and cooperation matrices of the 17 classics, ranking included, from ready strategies.
void classics_tournament(benchmark::State& state) {
  const auto roster = Registry::standard().roster("classics");
  const auto settings = over(static_cast<std::uint64_t>(state.range(0)));
  for (auto _ : state) {
    const auto tournament = play_tournament(roster, roster.size(), settings);
    benchmark::DoNotOptimize(tournament.signature());
  }
}
BENCHMARK(classics_tournament)->Arg(100)->Arg(1000)->Arg(1'000'000'000)->Unit(benchmark::kMicrosecond);

/// The same 153 matches round by round through the machine interface: what cycles save.
void classics_round_by_round(benchmark::State& state) {
  const auto roster = Registry::standard().roster("classics");
  const auto rounds = static_cast<std::uint64_t>(state.range(0));
  for (auto _ : state)
    for (std::size_t i = 0; i < roster.size(); ++i)
      for (std::size_t j = i; j < roster.size(); ++j) {
        const Machine& a = *roster[i].machine;
        const Machine& b = *roster[j].machine;
        State x = a.start();
        State y = b.start();
        std::array<std::uint64_t, 4> counts{};
        for (std::uint64_t t = 0; t < rounds; ++t) {
          const Move own = move_of(a, x);
          const Move theirs = move_of(b, y);
          ++counts[Outcome{own, theirs}.index()];
          x = a.next(x, own, theirs);
          y = b.next(y, theirs, own);
        }
        benchmark::DoNotOptimize(counts);
      }
}
BENCHMARK(classics_round_by_round)->Arg(1000)->Unit(benchmark::kMicrosecond);

/// The 2,048 strategies of memory(1,2) and memory(2,1), all against all, from their names on.
void both_families(benchmark::State& state) {
  const auto settings = over(static_cast<std::uint64_t>(state.range(0)));
  for (auto _ : state) {
    auto roster = Registry::standard().roster("memory(1,2),memory(2,1)");
    const std::size_t core = roster.size();
    const auto tournament = play_tournament(std::move(roster), core, settings);
    benchmark::DoNotOptimize(tournament.signature());
    state.counters["behaviours"] = static_cast<double>(tournament.behaviours());
  }
}
BENCHMARK(both_families)->Arg(1000)->Arg(1'000'000'000)->Unit(benchmark::kMillisecond);

/// One pair of memory(1,2) machines, cycle found and counted.
void one_pair(benchmark::State& state) {
  std::vector<CycleTable> tables;
  for (const auto& strategy : Registry::standard().roster("memory(1,2)"))
    tables.emplace_back(minimise(*tabulate(*strategy.machine, Sense::own_moves_its_own), Sense::own_moves_its_own));
  CycleFinder finder;
  const auto criterion = Criterion::finite(1000);
  std::size_t i = 0;
  for (auto _ : state) {
    i = (i + 397) % tables.size();
    benchmark::DoNotOptimize(finder.play(tables[i], tables[(i * 31 + 7) % tables.size()], criterion));
  }
}
BENCHMARK(one_pair);

/// The Markov chain of a pair of memory-one strategies.
void one_markov_pair(benchmark::State& state) {
  TournamentSettings settings = over(100);
  if (state.range(0) == 1) settings.criterion = Criterion::mean();
  const auto roster = Registry::standard().roster("gtft(0.3),joss(0.9)");
  for (auto _ : state) benchmark::DoNotOptimize(play_tournament(roster, 2, settings).signature());
}
BENCHMARK(one_markov_pair)->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace folk
