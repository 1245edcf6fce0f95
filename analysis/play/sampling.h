#pragma once
// How what cannot be solved is played.

#include <folk/games/match_rules.h>

#include <cstdint>

namespace folk {

/// How often a match is played: a whole number that cannot be 0, and stands wherever one does.
class Repetitions {
public:
  /// Throws UsageError for 0.
  Repetitions(std::uint64_t count);

  std::uint64_t count() const { return count_; }
  operator std::uint64_t() const { return count_; }

private:
  std::uint64_t count_;
};

/// How a pair is sampled.
struct Sampling : MatchRules {
  Repetitions repetitions = 100;
  std::uint64_t seed = 1;
  unsigned threads = 1;  ///< for players that think together
};

/// Rounds in which a long-run mean is sampled.
inline constexpr std::uint64_t long_run_rounds = 10'000;

}  // namespace folk
