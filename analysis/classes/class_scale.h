#pragma once
// In which whole numbers a class is scored, so that sums do not depend on their order and equals come out equal.

#include <folk/analysis/play/whole_payoffs.h>
#include <folk/games/match_rules.h>
#include <folk/strategies/standard/memory_class.h>

#include <cstdint>

namespace folk {

/// Scores of pairs as 64-bit whole numbers. Exact for finite:T, and for mean where cycles are short enough (all classes
/// with X, Y <= 2); otherwise each pair's score is rounded to a fixed point that leaves room for the sum over the
/// class.
struct ClassScale {
  WholePayoffs payoffs;
  bool exact = true;            ///< sums of whole numbers, nothing rounded
  std::int64_t common = 1;      ///< of exact means: a multiple of every cycle's length
  double score_unit = 1;        ///< a score divided by it is in the unit of the payoffs
  double cooperation_unit = 1;  ///< the same for cooperations, which weigh as the criterion weighs rounds
  double tolerance = 0;         ///< scores that differ by no more than this count as equal (whole payoffs, unscaled)
};

/// For sums over `weight` opponents. Throws UsageError where scores become too large to add up exactly.
ClassScale class_scale(const MemoryClass& members, const Payoffs& payoffs, const Criterion& criterion, double weight);

}  // namespace folk
