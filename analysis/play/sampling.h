#pragma once
// How what cannot be solved is played.

#include <folk/games/criterion.h>
#include <folk/games/payoffs.h>

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

}  // namespace folk
