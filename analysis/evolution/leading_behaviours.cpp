#include <folk/analysis/evolution/leading_behaviours.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace folk {
namespace {

/// Individuals of each behaviour.
std::vector<double> by_behaviour(const Behaviours& behaviours, const Population& population) {
  std::vector<double> numbers(behaviours.size(), 0);
  for (std::size_t member = 0; member < population.size(); ++member)
    numbers[behaviours.of_member[member]] += population[member];
  return numbers;
}

}  // namespace

LeadingBehaviours leading_behaviours(const std::shared_ptr<const ClassSelection>& selection, const Population& start,
                                     const EvolutionState& reached, std::size_t most, const Progress& progress) {
  const Behaviours& behaviours = selection->behaviours();
  const auto last = by_behaviour(behaviours, reached.population);
  std::vector<std::size_t> leaders(behaviours.size());
  std::iota(leaders.begin(), leaders.end(), std::size_t{0});
  std::stable_sort(leaders.begin(), leaders.end(), [&](std::size_t a, std::size_t b) { return last[a] > last[b]; });
  leaders.resize(std::min(leaders.size(), most));
  while (!leaders.empty() && !(last[leaders.back()] > 0)) leaders.pop_back();

  LeadingBehaviours found;
  found.others = behaviours.size() - leaders.size();
  for (const std::size_t behaviour : leaders) found.members.push_back(behaviours.first[behaviour]);
  Evolution again(selection, start);
  const auto note = [&] {
    const auto numbers = by_behaviour(behaviours, again.state().population);
    Population row;
    for (const std::size_t behaviour : leaders) row.push_back(numbers[behaviour]);
    // Whole numbers within 2^53: nothing is rounded.
    row.push_back(std::accumulate(numbers.begin(), numbers.end(), 0.0) - std::accumulate(row.begin(), row.end(), 0.0));
    found.rows.push_back({again.state().generation, std::move(row)});
  };
  note();
  again.run(reached.generation, progress, note);
  return found;
}

}  // namespace folk
