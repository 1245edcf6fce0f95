#pragma once
// Two deterministic machines, finite or with unbounded counters, played exactly however many the rounds.

#include <folk/analysis/play/pair_result.h>
#include <folk/games/criterion.h>
#include <folk/strategies/machine.h>

#include <cstdint>

namespace folk {

/// Rounds that are played one by one before a pair is given up.
inline constexpr std::uint64_t most_steps = 100'000'000;

/// Plays round by round until controls and counters repeat, and skips every run of rounds in which controls repeat and
/// only counters drift: a majority that drifts away from its threshold is over at once, a punishment of gradual costs
/// as much as one period of its opponent's answers.
///
/// The result is exact for finite (Method::cycle). For discounted and ending it is exact when a final loop is found or
/// less than 1e-18 of the weight is left, for mean when a final loop is found; otherwise what was played until a
/// counter overflowed or `steps` were made stands for the rest, marked Method::bounded. Throws UsageError when a finite
/// criterion needs more than `steps` steps or a counter outgrows its machine's state.
PairResult play_deterministic(const Machine& first, const Machine& second, const Criterion& criterion,
                              std::uint64_t steps = most_steps);

}  // namespace folk
