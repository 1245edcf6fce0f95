#include <folk/analysis/evolution/finite_population.h>
#include <folk/games/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace folk {

void require_fitness(const ScoreMatrix& scores, const SelectionRules& rules) {
  check(rules);
  if (rules.process != Process::birth_death || rules.fitness != Fitness::linear) return;
  double least = 0;
  for (std::size_t i = 0; i < scores.size(); ++i)
    for (std::size_t j = 0; j < scores.size(); ++j) least = std::min(least, scores.payoff(i, j));
  const double w = to_double(rules.intensity);
  if (1 - w + w * least < 0)
    throw UsageError(
        fmt::format("a payoff of {} a round with w {} is a negative fitness 1 - w + w payoff: choose a "
                    "smaller intensity or exponential fitness",
                    least, w));
}

FinitePopulation::FinitePopulation(std::shared_ptr<const ScoreMatrix> scores, const Population& start,
                                   const SelectionRules& rules, double mutation)
    : scores_(std::move(scores)),
      rules_(rules),
      intensity_(to_double(rules.intensity)),
      mutation_(mutation) {
  require_fitness(*scores_, rules);
  if (!(mutation >= 0 && mutation <= 1)) throw UsageError("mutation: expected a number from 0 to 1");
  if (mutation > 0 && scores_->size() < 2) throw UsageError("mutation needs two strategies");
  payoffs_.resize(scores_->behaviours() * scores_->behaviours());
  for (std::size_t i = 0; i < scores_->size(); ++i)
    for (std::size_t j = 0; j < scores_->size(); ++j)
      payoffs_[scores_->behaviour(i) * scores_->behaviours() + scores_->behaviour(j)] = scores_->payoff(i, j);
  for (const double number : start) total_ += number;
  if (!(total_ >= 2 && total_ <= most))
    throw UsageError(fmt::format("a population of {} individuals: expected 2 to 10^9 for a random model", total_));
}

std::string FinitePopulation::text() const { return fmt::format("{}, mutation {}", rules_.text(), mutation_); }

double FinitePopulation::payoff(const Population& now, std::size_t i) const {
  double sum = 0;
  for (std::size_t j = 0; j < now.size(); ++j)
    if (now[j] > 0) sum += now[j] * against(i, j);
  return rules_.meets_itself ? sum / total_ : (sum - against(i, i)) / (total_ - 1);
}

std::size_t FinitePopulation::newcomer(std::size_t strategy, RandomStream& random) const {
  if (mutation_ == 0 || !random.chance(mutation_)) return strategy;
  const auto others = static_cast<double>(scores_->size() - 1);
  const auto other = std::min(static_cast<std::size_t>(random.uniform() * others), scores_->size() - 2);
  return other < strategy ? other : other + 1;
}

void FinitePopulation::advance(Population& now, RandomStream& random) const {
  if (mutation_ == 0 && living(now) <= 1) return;
  if (rules_.process == Process::pairwise_comparison) {
    const std::size_t own = drawn_by(now, random);
    now[own] -= 1;  // the model is another individual
    const std::size_t model = drawn_by(now, random);
    now[own] += 1;
    std::size_t taken = own;
    if (own != model || mutation_ > 0) {
      const double difference = own == model ? 0 : payoff(now, model) - payoff(now, own);
      if (random.chance(1 / (1 + std::exp(-intensity_ * difference)))) taken = model;
    }
    taken = newcomer(taken, random);
    now[own] -= 1;
    now[taken] += 1;
    return;
  }
  std::vector<double> weights(now.size(), 0);
  std::vector<double> payoffs(now.size(), 0);
  double most_earned = -INFINITY;
  for (std::size_t i = 0; i < now.size(); ++i)
    if (now[i] > 0) {
      payoffs[i] = payoff(now, i);
      most_earned = std::max(most_earned, payoffs[i]);
    }
  for (std::size_t i = 0; i < now.size(); ++i)
    if (now[i] > 0)
      weights[i] = now[i] * (rules_.fitness == Fitness::linear ? 1 - intensity_ + intensity_ * payoffs[i]
                                                               : std::exp(intensity_ * (payoffs[i] - most_earned)));
  if (std::all_of(weights.begin(), weights.end(), [](double weight) { return !(weight > 0); })) return;
  const std::size_t born = newcomer(drawn_by(weights, random), random);
  const std::size_t dead = drawn_by(now, random);
  now[born] += 1;
  now[dead] -= 1;
}

}  // namespace folk
