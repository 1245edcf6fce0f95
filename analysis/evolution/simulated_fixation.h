#pragma once
// Who takes over a finite population, by simulation: for three strategies and more there is no formula.

#include <folk/analysis/evolution/dynamics.h>
#include <folk/games/progress.h>

#include <cstdint>
#include <functional>
#include <vector>

namespace folk {

/// What came of so many runs; runs are counted in order, so that counts can be kept and gone on with.
struct FixationCounts {
  std::uint64_t runs = 0;
  std::vector<std::uint64_t> taken_over;  ///< by strategy
  std::uint64_t unsettled = 0;            ///< runs that did not end within the generations they were given

  /// The share of the runs that a strategy took over, and its standard error, sqrt(p (1 - p) / runs).
  double share(std::size_t strategy) const;
  double standard_error(std::size_t strategy) const;
};

/// Runs from `counts.runs` on up to `runs`, each from `start` until one strategy is left or `most_generations` are
/// over. A run's random numbers are those of its number, so that neither threads nor interruptions change anything.
/// `counts` grows by blocks of runs; after each `block_done` is called, by the caller's thread. Throws Cancelled, and
/// what the calls throw; `counts` then holds the blocks that were done. Throws UsageError where the model mutates, for
/// then no strategy takes over for good.
void simulate_fixation(FixationCounts& counts, const Dynamics& dynamics, const Population& start, std::uint64_t runs,
                       std::uint64_t most_generations, std::uint64_t seed, unsigned threads,
                       const Progress& progress = nullptr, const std::function<void()>& block_done = nullptr);

}  // namespace folk
