#include <folk/analysis/evolution/evolution_seed.h>
#include <folk/analysis/evolution/simulated_fixation.h>
#include <folk/analysis/play/parallel.h>
#include <folk/games/error.h>

#include <algorithm>
#include <cmath>

namespace folk {
namespace {

/// Runs that are counted together.
constexpr std::uint64_t block_size = 256;

/// The strategy that is left alone; the number of strategies where several are.
std::size_t sole_survivor(const Population& population) {
  std::size_t found = population.size();
  for (std::size_t i = 0; i < population.size(); ++i)
    if (population[i] > 0) {
      if (found < population.size()) return population.size();
      found = i;
    }
  return found;
}

}  // namespace

double FixationCounts::share(std::size_t strategy) const {
  return runs > 0 ? static_cast<double>(taken_over[strategy]) / static_cast<double>(runs) : 0;
}

double FixationCounts::standard_error(std::size_t strategy) const {
  const double p = share(strategy);
  return runs > 0 ? std::sqrt(p * (1 - p) / static_cast<double>(runs)) : 0;
}

void simulate_fixation(FixationCounts& counts, const Dynamics& dynamics, const Population& start, std::uint64_t runs,
                       std::uint64_t most_generations, std::uint64_t seed, unsigned threads, const Progress& progress,
                       const std::function<void()>& block_done) {
  if (!dynamics.stays_uniform())
    throw UsageError("with mutation no strategy takes over for good: ask for fixation without it");
  counts.taken_over.resize(start.size(), 0);
  while (counts.runs < runs) {
    const std::uint64_t first = counts.runs;
    const std::uint64_t count = std::min(block_size, runs - first);
    std::vector<std::size_t> winners(count, start.size());
    parallel_for(count, threads, [&](std::size_t run, unsigned) {
      RandomStream random(run_key(seed, first + run));
      Population now = start;
      for (std::uint64_t generation = 0; generation < most_generations; ++generation) {
        if ((winners[run] = sole_survivor(now)) < now.size()) return;
        if (generation % 1024 == 0) progress.check();
        dynamics.advance(now, random);
      }
      winners[run] = sole_survivor(now);
    });
    for (const std::size_t winner : winners) ++(winner < start.size() ? counts.taken_over[winner] : counts.unsettled);
    counts.runs += count;
    if (block_done) block_done();
    progress(static_cast<double>(counts.runs) / static_cast<double>(runs));
  }
}

}  // namespace folk
