#include <folk/analysis/evolution/class_selection.h>
#include <folk/games/error.h>
#include <folk/games/int128.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace folk {
namespace {

/// A payoff of 1 for each C of one's own.
Payoffs one_a_cooperation() {
  Payoffs payoffs;
  payoffs.reward = payoffs.sucker = 1;
  payoffs.temptation = payoffs.punishment = 0;
  return payoffs;
}

double sum_of(const Population& population) { return std::accumulate(population.begin(), population.end(), 0.0); }

}  // namespace

ClassSelection::ClassSelection(const MemoryClass& members, const Payoffs& payoffs, const Criterion& criterion,
                               const Population& start, unsigned threads, const Progress& progress, const Crew& crew)
    : incomes_(members, payoffs, criterion, sum_of(start), threads, crew),
      cooperations_(members, one_a_cooperation(), criterion, sum_of(start), threads, crew),
      behaviours_(behaviours_of(members, threads, progress)),
      own_copies_(incomes_.own_copies(behaviours_.first)),
      total_(sum_of(start)) {
  for (const Rational& payoff : payoffs.by_outcome())
    if (payoff < 0) throw UsageError("populations that grow in proportion to scores cannot have negative ones");
  if (!(total_ > 0 && total_ <= most_individuals))
    throw UsageError(fmt::format("a population of {} individuals: expected 1 to 10^15", total_));
  // The largest number on the way is N n_i f_i, and n_i f_i is below 2^63 N.
  if (2 * std::log2(total_) + 63 > 126)
    throw UsageError(fmt::format("a population of {} individuals is too large to be counted exactly", total_));
}

ClassSelection::Living ClassSelection::living_of(const Population& now) const {
  std::vector<std::int64_t> numbers(behaviours_.size(), 0);
  for (std::size_t i = 0; i < now.size(); ++i) numbers[behaviours_.of_member[i]] += static_cast<std::int64_t>(now[i]);
  Living living;
  for (std::uint32_t b = 0; b < numbers.size(); ++b) {
    if (numbers[b] == 0) continue;
    living.behaviours.push_back(b);
    living.members.push_back(behaviours_.first[b]);
    living.numbers.push_back(numbers[b]);
  }
  return living;
}

void ClassSelection::advance(Population& now, RandomStream&) const {
  const Living living = living_of(now);
  const auto incomes = incomes_(living.members, living.numbers);
  std::vector<Int128> each(behaviours_.size(), 0);  // what an individual earns
  Int128 all = 0;
  for (std::size_t i = 0; i < living.behaviours.size(); ++i) {
    const std::uint32_t b = living.behaviours[i];
    each[b] = Int128(incomes[i]) - own_copies_[b];
    all += each[b] * living.numbers[i];
  }
  if (!(all > 0)) return;
  const auto total = static_cast<std::int64_t>(total_);
  for (std::size_t i = 0; i < now.size(); ++i)
    if (now[i] > 0)
      now[i] = static_cast<double>(
          static_cast<std::int64_t>(total * (Int128(now[i]) * each[behaviours_.of_member[i]]) / all));
}

double ClassSelection::cooperation(const Population& now) const {
  const Living living = living_of(now);
  const auto moves = cooperations_(living.members, living.numbers);
  const auto own = cooperations_.own_copies(living.members);
  double sum = 0;
  double all = 0;
  for (std::size_t i = 0; i < living.numbers.size(); ++i) {
    sum += static_cast<double>(living.numbers[i]) * static_cast<double>(moves[i] - own[i]);
    all += static_cast<double>(living.numbers[i]);
  }
  const double rounds = cooperations_.scale().score_unit * cooperations_.total_weight();
  return all > 1 ? sum / (all * (all - 1)) / rounds : static_cast<double>(own[0]) / rounds;
}

}  // namespace folk
