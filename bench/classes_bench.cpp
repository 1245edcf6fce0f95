// What complete classes cost, beside playing their pairs one after the other in the same run.

#include <benchmark/benchmark.h>
#include <folk/analysis/classes/class_incomes.h>
#include <folk/analysis/classes/class_score.h>
#include <folk/analysis/classes/class_tournament.h>
#include <folk/analysis/play/cycle_table.h>
#include <folk/strategies/automaton.h>
#include <folk/strategies/registry.h>
#include <folk/strategies/standard/memory_class.h>

#include <algorithm>
#include <ctime>
#include <numeric>
#include <string>
#include <vector>

namespace folk {
namespace {

/// Processor time: what else runs on the machine does not count.
double seconds_since(std::clock_t begin) { return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC; }

std::vector<CycleTable> minimal_tables(const MemoryClass& members) {
  std::vector<CycleTable> tables;
  for (std::uint64_t i = 0; i < std::uint64_t{1} << members.genes(); ++i)
    tables.emplace_back(minimise(*tabulate(members.member(i), Sense::own_moves_its_own), Sense::own_moves_its_own));
  return tables;
}

/// Nanoseconds a pair when the pairs of some members with all are played one after the other, each to its cycle. Every
/// pair is met once, so that half a row stands for a row.
double plain_nanoseconds(const std::vector<CycleTable>& tables, std::size_t rows) {
  CycleFinder finder;
  const auto criterion = Criterion::finite(1000);
  const auto begin = std::clock();
  for (std::size_t row = 0; row < rows; ++row) {
    const CycleTable& own = tables[row * (tables.size() / rows)];
    for (std::size_t i = 0; i < tables.size(); i += 2) benchmark::DoNotOptimize(finder.play(own, tables[i], criterion));
  }
  return 2 * 1e9 * seconds_since(begin) / static_cast<double>(rows * tables.size());
}

/// The ranking of all of memory(X,Y) over 1,000 rounds, beside pairs played one after the other: all of memory(1,2)'s,
/// of memory(2,2)'s the rows of 64 members, made ready before, which stand for all 262,144 rows.
void class_ranking(benchmark::State& state) {
  const MemoryClass members(static_cast<unsigned>(state.range(0)), static_cast<unsigned>(state.range(1)));
  const auto tables = minimal_tables(members);
  ClassSettings settings;
  settings.criterion = Criterion::finite(1000);
  double plain = 0;
  double best = 1e9;
  for (auto _ : state) {
    plain = plain == 0 ? plain_nanoseconds(tables, std::min<std::size_t>(tables.size(), 64)) : plain;
    const auto begin = std::clock();
    benchmark::DoNotOptimize(play_class(members, settings).ranking().data());
    const double seconds = seconds_since(begin);
    best = std::min(best, seconds);
    state.SetIterationTime(seconds);
  }
  const auto size = static_cast<double>(tables.size());
  const double pairs = size * (size + 1) / 2;
  state.counters["plain_ns_a_pair"] = plain;
  state.counters["plain_s_in_all"] = plain * pairs / 1e9;
  state.counters["ns_a_pair"] = best / pairs * 1e9;
  state.counters["ratio"] = plain * pairs / 1e9 / best;
}
BENCHMARK(class_ranking)
    ->ArgNames({"X", "Y"})
    ->Args({1, 1})
    ->Args({1, 2})
    ->Args({2, 2})
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

/// tit_for_tat against all of memory(k,k).
void score_of_tit_for_tat(benchmark::State& state) {
  const auto memory = static_cast<unsigned>(state.range(0));
  const MemoryClass members(memory, memory);
  const auto machine = Registry::standard().make("tit_for_tat").machine;
  ClassScoreSettings settings;
  settings.criterion = Criterion::finite(1000);
  for (auto _ : state) {
    const ClassScore score = score_against(members, *machine, settings);
    state.counters["leaves"] = static_cast<double>(score.leaves);
    state.counters["log2_members"] = members.genes();
  }
}
BENCHMARK(score_of_tit_for_tat)->ArgName("k")->DenseRange(1, 4)->Unit(benchmark::kMicrosecond);

/// The first generation of the ecology of memory(2,2): everybody is alive.
void class_generation(benchmark::State& state) {
  const MemoryClass members(2, 2);
  const std::size_t size = std::size_t{1} << members.genes();
  const ClassIncomes incomes(members, Payoffs{}, Criterion::finite(1000), 100.0 * static_cast<double>(size));
  std::vector<std::uint32_t> all(size);
  std::iota(all.begin(), all.end(), 0U);
  const std::vector<std::int64_t> numbers(size, 100);
  for (auto _ : state) benchmark::DoNotOptimize(incomes(all, numbers).data());
}
BENCHMARK(class_generation)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace folk
