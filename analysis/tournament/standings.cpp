#include <folk/analysis/tournament/standings.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace folk {

void rank_by_total(std::vector<Standing>& standings, long double slack) {
  std::sort(standings.begin(), standings.end(), [](const Standing& a, const Standing& b) {
    return std::pair(-a.total, a.entrant) < std::pair(-b.total, b.entrant);
  });
  for (auto first = standings.begin(); first != standings.end();) {
    const auto last = std::find_if(first, standings.end(), [&](const Standing& other) {
      return other.exact && first->exact ? other.total != first->total : std::abs(other.total - first->total) > slack;
    });
    // Totals that differ by rounding alone stand in roster order, like equal ones.
    std::sort(first, last, [](const Standing& a, const Standing& b) { return a.entrant < b.entrant; });
    const auto shared = static_cast<std::size_t>(first - standings.begin()) + 1;
    for (; first != last; ++first) first->rank = shared;
  }
}

}  // namespace folk
