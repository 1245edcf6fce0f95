#pragma once
// What cannot be solved is played: the mean of repetitions, with its standard error.

#include <folk/analysis/play/pair_result.h>
#include <folk/games/criterion.h>
#include <folk/games/payoffs.h>
#include <folk/strategies/strategy.h>

#include <cstdint>

namespace folk {

/// How a pair is sampled.
struct Sampling {
  Payoffs payoffs;
  Criterion criterion = Criterion::finite(100);
  double noise = 0;
  std::uint64_t repetitions = 100;
  std::uint64_t seed = 1;
  unsigned threads = 1;  ///< for players that think together
};

/// Rounds in which a long-run mean is sampled.
inline constexpr std::uint64_t long_run_rounds = 10'000;

/// Plays the pair again and again, as play_group does; match r draws from the keys (seed, pair, r, role).
/// finite: T rounds. ending: the length of each match is drawn. discounted: until what is left weighs less than 1e-12.
/// mean: long_run_rounds rounds. Throws UsageError when that is more than 10^8 rounds in all.
PairResult play_sampled(const Strategy& first, const Strategy& second, std::uint64_t pair, const Sampling& sampling);

}  // namespace folk
