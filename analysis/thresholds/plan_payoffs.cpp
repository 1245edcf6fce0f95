#include <folk/analysis/thresholds/plan_payoffs.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace folk {

PlanPayoffs::PlanPayoffs(std::vector<std::uint32_t> next, std::vector<Integer> payoff)
    : next_(std::move(next)),
      payoff_(std::move(payoff)),
      before_(next_.size(), 0),
      period_(next_.size(), 0) {
  std::vector<std::uint32_t> walked_from(next_.size(), ~0U);
  std::vector<std::uint32_t> walk;
  for (std::uint32_t start = 0; start < next_.size(); ++start) {
    walk.clear();
    std::uint32_t state = start;
    for (; walked_from[state] == ~0U; state = next_[state]) {
      walked_from[state] = start;
      walk.push_back(state);
    }
    if (walked_from[state] == start && period_[state] == 0) {
      const auto entry = std::find(walk.begin(), walk.end(), state);
      close_cycle({entry, walk.end()});
      walk.erase(entry, walk.end());
    }
    for (; !walk.empty(); walk.pop_back()) {
      const std::uint32_t last = walk.back();
      before_[last] = before_[next_[last]] + 1;
      period_[last] = period_[next_[last]];
      outside_.push_back(last);
    }
  }
}

void PlanPayoffs::close_cycle(const std::vector<std::uint32_t>& cycle) {
  const std::size_t length = cycle.size();
  std::size_t period = 1;
  const auto repeats = [&] {
    for (std::size_t i = 0; i + period < length; ++i)
      if (payoff_[cycle[i]] != payoff_[cycle[i + period]]) return false;
    return true;
  };
  while (length % period != 0 || !repeats()) ++period;
  for (const std::uint32_t state : cycle) period_[state] = period;
  cycles_.push_back(cycle);
}

std::vector<double> PlanPayoffs::values(double d) const {
  std::vector<double> payoff(payoff_.size());
  for (std::size_t i = 0; i < payoff.size(); ++i) payoff[i] = to_double(payoff_[i]);
  std::vector<double> value(payoff.size());
  for (const auto& cycle : cycles_) {
    double lap = 0;
    for (std::size_t i = cycle.size(); i-- > 0;) lap = payoff[cycle[i]] + d * lap;
    value[cycle[0]] = lap / (1 - std::pow(d, static_cast<double>(cycle.size())));
    for (std::size_t i = cycle.size(); i-- > 1;) value[cycle[i]] = payoff[cycle[i]] + d * value[next_[cycle[i]]];
  }
  for (const std::uint32_t state : outside_) value[state] = payoff[state] + d * value[next_[state]];
  return value;
}

std::optional<Polynomial> advantage(const Prospect& a, const Prospect& b, std::size_t most_terms) {
  const std::size_t k = a.plan.period(a.then);
  const std::size_t l = b.plan.period(b.then);
  const std::size_t common = std::gcd(k, l);
  const std::size_t before = 1 + std::max(a.plan.rounds_before(a.then), b.plan.rounds_before(b.then));
  const std::size_t order = k + l - common;
  const std::size_t terms = before + order;
  if (terms > most_terms) return std::nullopt;
  std::vector<Integer> difference{a.now - b.now};
  std::uint32_t x = a.then;
  std::uint32_t y = b.then;
  for (; difference.size() < terms; x = a.plan.next(x), y = b.plan.next(y)) {
    if (&a.plan == &b.plan && x == y) return Polynomial(std::move(difference));
    difference.push_back(a.plan.payoff(x) - b.plan.payoff(y));
  }
  // After `before` rounds the differences obey a linear recurrence of this order: all zero, they stay zero.
  if (std::all_of(difference.begin() + static_cast<std::ptrdiff_t>(before), difference.end(),
                  [](const Integer& c) { return c.is_zero(); }))
    return Polynomial(std::move(difference));
  // The product with (1 - d^k)(1 - d^l) / (1 - d^common), whose terms from here on vanish.
  for (std::size_t i = terms; i-- > k;) difference[i] -= difference[i - k];
  for (std::size_t i = terms; i-- > l;) difference[i] -= difference[i - l];
  for (std::size_t i = common; i < terms; ++i) difference[i] += difference[i - common];
  return Polynomial(std::move(difference));
}

}  // namespace folk
