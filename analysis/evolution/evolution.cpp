#include <folk/analysis/evolution/evolution.h>
#include <folk/analysis/evolution/evolution_seed.h>
#include <folk/analysis/play/signature.h>
#include <folk/games/error.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace folk {
namespace {

/// True for 0 to 100, then for a digit and zeros.
bool is_summed_up(std::uint64_t generation) {
  std::uint64_t power = 1;
  while (power <= generation / 10) power *= 10;
  return generation <= 100 || generation % power == 0;
}

}  // namespace

GenerationSummary summary_of(std::uint64_t generation, const Population& population) {
  GenerationSummary summary{generation, 0, 0, 0, 0};
  for (std::size_t i = 0; i < population.size(); ++i) {
    if (population[i] > 0) ++summary.living;
    summary.individuals += population[i];
    if (population[i] > summary.number) {
      summary.leader = i;
      summary.number = population[i];
    }
  }
  return summary;
}

Evolution::Evolution(DynamicsPtr dynamics, Population start, std::uint64_t seed)
    : dynamics_(std::move(dynamics)),
      start_(std::move(start)),
      seed_(seed) {
  double sum = 0;
  for (const double number : start_) {
    if (!(number >= 0 && std::isfinite(number)))
      throw UsageError("a population holds a number that is negative or none");
    sum += number;
  }
  if (!(sum > 0)) throw UsageError("a population needs somebody");
  if (dynamics_->has_shares())
    for (double& share : start_) share /= sum;
  state_.population = start_;
  state_.extinct_at.assign(start_.size(), 0);
  state_.history.add(0, start_);
  state_.summaries.push_back(summary_of(0, start_));
  state_.marked = start_;
}

void Evolution::look_for_end(const Population& before) {
  const Population& now = state_.population;
  if (dynamics_->is_random()) {
    if (dynamics_->stays_uniform() && living(now) == 1) state_.end = EvolutionEnd::uniform;
    return;
  }
  double change = 0;
  for (std::size_t i = 0; i < now.size(); ++i) change = std::max(change, std::abs(now[i] - before[i]));
  if (change <= dynamics_->tolerance()) {
    state_.end = EvolutionEnd::fixed_point;
  } else if (dynamics_->stays_uniform() && living(now) == 1) {
    state_.end = EvolutionEnd::uniform;
  } else if (now == state_.marked) {
    state_.end = EvolutionEnd::cycle;
    state_.period = state_.generation - state_.marked_generation;
  } else if (state_.generation >= 2 * state_.marked_generation) {
    state_.marked = now;
    state_.marked_generation = state_.generation;
  }
}

void Evolution::run(std::uint64_t generations, const Progress& progress, const std::function<void()>& after) {
  Population before;
  while (state_.end == EvolutionEnd::none && state_.generation < generations) {
    before = state_.population;
    RandomStream random(generation_key(seed_, state_.generation));
    dynamics_->advance(state_.population, random);
    ++state_.generation;
    for (std::size_t i = 0; i < before.size(); ++i) {
      const bool lives = state_.population[i] > 0;
      if (before[i] > 0 && !lives) state_.extinct_at[i] = state_.generation;
      if (lives) state_.extinct_at[i] = 0;  // mutation brings back
    }
    state_.history.add(state_.generation, state_.population);
    if (is_summed_up(state_.generation)) state_.summaries.push_back(summary_of(state_.generation, state_.population));
    look_for_end(before);
    if (after) after();
    if (state_.end == EvolutionEnd::none)
      progress(static_cast<double>(state_.generation) / static_cast<double>(generations));
  }
  if (state_.end != EvolutionEnd::none) progress(1);
}

std::vector<PopulationRank> Evolution::ranking() const {
  std::vector<PopulationRank> ranking(start_.size());
  for (std::size_t i = 0; i < ranking.size(); ++i) {
    ranking[i].entrant = i;
    ranking[i].population = state_.population[i];
    // Who was not there at the start died in generation 0.
    if (!(state_.population[i] > 0)) ranking[i].extinct_at = state_.extinct_at[i];
  }
  std::stable_sort(ranking.begin(), ranking.end(), [](const PopulationRank& a, const PopulationRank& b) {
    if (a.population != b.population) return a.population > b.population;
    return a.extinct_at.value_or(std::numeric_limits<std::uint64_t>::max()) >
           b.extinct_at.value_or(std::numeric_limits<std::uint64_t>::max());
  });
  for (std::size_t r = 0; r < ranking.size(); ++r) ranking[r].rank = r + 1;
  return ranking;
}

std::uint64_t Evolution::identity() const {
  Signature signature;
  signature.add(dynamics_->text());
  signature.add(dynamics_->is_random() ? seed_ : 0);
  for (const double number : start_) signature.add(number);
  return signature.value();
}

}  // namespace folk
