#pragma once
// Who comes first: totals in order, equal ones sharing a rank.

#include <cstddef>
#include <vector>

namespace folk {

/// An entrant's total, and the rank that it gets among others.
struct Standing {
  std::size_t entrant = 0;  ///< place in the roster
  long double total = 0;
  bool exact = true;     ///< without any rounding
  std::size_t rank = 0;  ///< 1 is best
};

/// Sorts best first and gives ranks. Equal totals share the best rank that they take together (1, 2, 2, 4) and stand in
/// roster order; totals of which one is not exact count as equal when they differ by at most `slack`.
void rank_by_total(std::vector<Standing>& standings, long double slack);

}  // namespace folk
