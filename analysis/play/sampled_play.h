#pragma once
// What cannot be solved is played: the mean of repetitions, with its standard error.

#include <folk/analysis/play/pair_result.h>
#include <folk/analysis/play/sampling.h>
#include <folk/strategies/strategy.h>

#include <cstdint>

namespace folk {

/// Plays the pair again and again, as play_group does; match r draws from match_key(seed, pair, r, role).
/// finite: T rounds. ending: the length of each match is drawn. discounted: until what is left weighs less than 1e-12.
/// mean: long_run_rounds rounds. Throws UsageError when that is more than 10^8 rounds in all.
PairResult play_sampled(const Strategy& first, const Strategy& second, std::uint64_t pair, const Sampling& sampling);

}  // namespace folk
