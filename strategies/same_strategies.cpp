#include <folk/strategies/equivalence.h>
#include <folk/strategies/same_strategies.h>

#include <algorithm>

namespace folk {
namespace {

/// Whether a long run of one move and then of the other is answered differently: it reaches what breadth first never
/// sees of machines with large memories.
bool separated_by_runs(const Machine& a, const Machine& b) {
  constexpr int longest = 64;
  for (const Move first : {Move::C, Move::D})
    for (int run = 1; run <= longest; ++run) {
      State of_a = a.start(), of_b = b.start();
      for (int round = 0; round < 2 * run + longest; ++round) {
        const double cooperation = a.cooperation(of_a);
        if (cooperation != b.cooperation(of_b)) return true;
        const Move own = cooperation > 0 ? Move::C : Move::D;
        const Move theirs = round < run ? first : other(first);
        of_a = a.next(of_a, own, theirs);
        of_b = b.next(of_b, own, theirs);
      }
    }
  return false;
}

}  // namespace

SameStrategies same_strategies(const std::vector<Strategy>& strategies, Sense sense, std::size_t most_pairs) {
  SameStrategies found;
  for (std::size_t i = 0; i < strategies.size(); ++i) {
    if (!strategies[i].machine) {
      found.opaque.push_back(i);
      continue;
    }
    const auto is_one_of = [&](const std::vector<std::size_t>& group) {
      const auto& first = strategies[group.front()].machine;
      const auto result = compare(*first, *strategies[i].machine, sense, most_pairs).equivalence;
      if (result == Equivalence::undecided && !separated_by_runs(*first, *strategies[i].machine))
        found.undecided.emplace_back(group.front(), i);
      return result == Equivalence::equivalent;
    };
    const auto group = std::find_if(found.groups.begin(), found.groups.end(), is_one_of);
    if (group == found.groups.end()) {
      found.groups.push_back({i});
    } else {
      group->push_back(i);
    }
  }
  std::erase_if(found.groups, [](const auto& group) { return group.size() == 1; });
  return found;
}

}  // namespace folk
