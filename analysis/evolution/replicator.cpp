#include <folk/analysis/evolution/replicator.h>
#include <folk/games/error.h>

#include <fmt/format.h>

#include <utility>

namespace folk {

Replicator::Replicator(std::shared_ptr<const ScoreMatrix> scores, const ReplicatorSettings& settings)
    : scores_(std::move(scores)),
      settings_(settings) {
  scores_->require_no_negative_score();
  if (!(settings.resilience >= 0 && settings.resilience < 1))
    throw UsageError("resilience: expected a number from 0 up to but not 1");
  if (!(settings.mutation >= 0 && settings.mutation <= 1)) throw UsageError("mutation: expected a number from 0 to 1");
  if (!(settings.tolerance >= 0)) throw UsageError("tolerance: expected a number from 0 on");
  if (settings.mutation > 0 && scores_->size() < 2) throw UsageError("mutation needs two strategies");
}

std::string Replicator::text() const {
  return fmt::format("replicator equation, income {}, resilience {}, mutation {}, tolerance {}",
                     to_string(settings_.income), settings_.resilience, settings_.mutation, settings_.tolerance);
}

void Replicator::advance(Population& now, RandomStream&) const {
  const std::size_t n = now.size();
  std::vector<double> members(scores_->behaviours(), 0);
  for (std::size_t i = 0; i < n; ++i) members[scores_->behaviour(i)] += now[i];
  std::vector<double> income(members.size(), 0);
  for (std::size_t a = 0; a < members.size(); ++a) {
    if (!(members[a] > 0)) continue;
    for (std::size_t b = 0; b < members.size(); ++b)
      if (members[b] > 0) income[a] += members[b] * static_cast<double>(scores_->whole(a, b));
  }
  std::vector<double> earned(n, 0);
  double all = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t a = scores_->behaviour(i);
    const double own = settings_.income == Income::communal ? now[i] * static_cast<double>(scores_->whole(a, a)) : 0;
    earned[i] = now[i] * (income[a] - own);
    all += earned[i];
  }
  if (!(all > 0)) return;
  const double others = settings_.mutation > 0 ? settings_.mutation / static_cast<double>(n - 1) : 0;
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double share = earned[i] / all;
    const double born = (1 - settings_.mutation) * share + others * (1 - share);
    now[i] = settings_.resilience * now[i] + (1 - settings_.resilience) * born;
    sum += now[i];
  }
  for (double& share : now) share /= sum;  // rounding does not leave the simplex
}

}  // namespace folk
