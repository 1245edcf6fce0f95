#include <folk/analysis/evolution/population_cooperation.h>

namespace folk {

std::optional<double> population_cooperation(const ScoreMatrix& scores, const Population& population,
                                             bool meets_itself) {
  if (!scores.has_cooperation()) return std::nullopt;
  std::vector<std::size_t> member(scores.behaviours(), 0);
  std::vector<double> members(scores.behaviours(), 0);
  double own = 0;
  double all = 0;
  for (std::size_t i = 0; i < population.size(); ++i) {
    member[scores.behaviour(i)] = i;
    members[scores.behaviour(i)] += population[i];
    if (population[i] > 0) own += population[i] * *scores.cooperation(i, i);
    all += population[i];
  }
  double sum = 0;
  for (std::size_t a = 0; a < members.size(); ++a)
    for (std::size_t b = 0; b < members.size(); ++b)
      if (members[a] > 0 && members[b] > 0) sum += members[a] * members[b] * *scores.cooperation(member[a], member[b]);
  return meets_itself || !(all > 1) ? sum / (all * all) : (sum - own) / (all * (all - 1));
}

}  // namespace folk
