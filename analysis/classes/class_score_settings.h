#pragma once
// How a strategy is scored against a class, and when that is given up.

#include <folk/games/error.h>
#include <folk/games/match_rules.h>

#include <cstdint>

namespace folk {

/// A walk through a class told more kinds of opponents apart than it may.
class TooManyKinds : public UsageError {
public:
  using UsageError::UsageError;
};

/// What an entrant is scored for.
struct ClassScoreSettings {
  Payoffs payoffs;
  Criterion criterion = Criterion::finite(100);
  unsigned threads = 1;  ///< the results do not depend on it
  /// A walk with more leaves is given up. A leaf is what the opponents that answer alike have in common.
  std::uint64_t most_leaves = 1'000'000'000;
};

}  // namespace folk
