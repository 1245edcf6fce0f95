#include <folk/analysis/play/chain_values.h>
#include <folk/analysis/replies/flow.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace folk {
namespace {

/// Sum of rewards[i] (a/b)^i for first <= i < last, counted from i = first, times b^(last - first - 1).
Integer scaled_sum(const std::vector<std::int64_t>& rewards, std::size_t first, std::size_t last, const Integer& a,
                   const Integer& b) {
  Integer sum = 0;
  Integer power = 1;  // b^(terms so far)
  for (std::size_t i = last; i-- > first;) {
    sum *= a;
    sum += rewards[i] * power;
    power *= b;
  }
  return sum;
}

std::int64_t whole(double reward) { return static_cast<std::int64_t>(reward); }

}  // namespace

Flow::Flow(std::vector<std::uint32_t> next, std::vector<double> rewards, const Rational& scale,
           const Criterion& criterion)
    : next_(std::move(next)),
      rewards_(std::move(rewards)),
      exact_scale_(numerator(scale)),
      scale_(to_double(scale)),
      criterion_(criterion) {
  if (criterion.is_finite()) throw std::logic_error("a flow has no end: finite criteria are summed round by round");
  find_cycles();
  evaluate();
}

void Flow::find_cycles() {
  constexpr auto unknown = std::numeric_limits<std::uint32_t>::max();
  cycle_of_.assign(size(), unknown);
  rounds_to_cycle_.assign(size(), 0);
  std::vector<std::uint32_t> seen_in(size(), unknown);  // the walk that first came here
  std::vector<std::uint32_t> walk;
  for (std::uint32_t start = 0; start < size(); ++start) {
    walk.clear();
    std::uint32_t state = start;
    while (seen_in[state] == unknown) {
      seen_in[state] = start;
      walk.push_back(state);
      state = next_[state];
    }
    auto before = walk.end();
    if (seen_in[state] == start && cycle_of_[state] == unknown) {
      before = std::find(walk.begin(), walk.end(), state);
      for (auto it = before; it != walk.end(); ++it) cycle_of_[*it] = static_cast<std::uint32_t>(cycles_.size());
      cycles_.emplace_back(before, walk.end());
    }
    for (auto it = before; it != walk.begin();) {
      --it;
      cycle_of_[*it] = cycle_of_[state];
      rounds_to_cycle_[*it] = rounds_to_cycle_[next_[*it]] + 1;
      order_.push_back(*it);
    }
  }
  // Each walk was added last state first, and walks lead into earlier ones: every state follows its successor.
}

void Flow::evaluate() {
  values_.assign(size(), 0);
  double largest = 1;
  for (const double reward : rewards_) largest = std::max(largest, std::abs(reward));
  largest /= scale_;
  if (criterion_.kind() == Criterion::Kind::mean) {
    doubt_ = (64 + static_cast<double>(size())) * 0x1p-53 * largest;  // a lap may be a sum of `size` rewards
    std::vector<double> means;
    for (const auto& cycle : cycles_) {
      double sum = 0;
      for (const auto c : cycle) sum += rewards_[c];
      means.push_back(sum / static_cast<double>(cycle.size()) / scale_);
    }
    for (std::size_t s = 0; s < size(); ++s) values_[s] = means[cycle_of_[s]];
    return;
  }
  // A few roundings a round, discounted like the payoffs they are in.
  doubt_ = 64 * 0x1p-53 * largest * criterion_.total_weight() / criterion_.stopping();
  const double d = criterion_.continuation();
  const double weight = first_weight(criterion_);
  for (const auto& cycle : cycles_) {
    double sum = 0;
    for (std::size_t i = cycle.size(); i-- > 0;) sum = rewards_[cycle[i]] + d * sum;
    values_[cycle[0]] = weight / scale_ * sum / criterion_.lost_within(static_cast<double>(cycle.size()));
    for (std::size_t i = cycle.size(); i-- > 1;)
      values_[cycle[i]] = weight * rewards_[cycle[i]] / scale_ + d * values_[cycle[i + 1 == cycle.size() ? 0 : i + 1]];
  }
  for (const auto s : order_) values_[s] = weight * rewards_[s] / scale_ + d * values_[next_[s]];
}

Flow::Course Flow::course_from(std::uint32_t state) const {
  Course course;
  course.cycle = rounds_to_cycle_[state];
  const std::size_t length = course.cycle + cycles_[cycle_of_[state]].size();
  course.rewards.reserve(length);
  for (; course.rewards.size() < length; state = next_[state]) course.rewards.push_back(whole(rewards_[state]));
  return course;
}

Flow::Fraction Flow::discounted_sum(const Course& course) const {
  const Rational d = criterion_.exact_continuation();
  const Integer a(numerator(d));
  const Integer b(denominator(d));
  const auto exponent = [](std::size_t n) { return static_cast<unsigned>(n); };
  const std::size_t before = course.cycle;
  const std::size_t length = course.rewards.size() - before;
  const Integer b_before = pow(b, exponent(before));
  const Integer a_before = pow(a, exponent(before));
  // cycle sum / (1 - d^L) = [sum b^(L-1)] b / (b^L - a^L); the rounds before it: [sum b^(n-1)] b / b^n.
  const Integer around = scaled_sum(course.rewards, before, course.rewards.size(), a, b) * b;
  const Integer lap = pow(b, exponent(length)) - pow(a, exponent(length));
  const Integer ahead = before == 0 ? Integer(0) : scaled_sum(course.rewards, 0, before, a, b) * b;
  Integer above = ahead * lap + around * a_before;
  Integer below = b_before * lap * exact_scale_;
  if (criterion_.kind() == Criterion::Kind::discounted) {
    above *= b - a;
    below *= b;
  }
  return {above, below};
}

Rational Flow::value(std::uint32_t state) const {
  if (criterion_.kind() != Criterion::Kind::mean) {
    const Fraction sum = discounted_sum(course_from(state));
    return {sum.above, sum.below};
  }
  const auto& cycle = cycles_[cycle_of_[state]];
  Integer sum = 0;
  for (const auto c : cycle) sum += whole(rewards_[c]);
  return {sum, cycle.size() * exact_scale_};
}

/// Sum over these rounds alone, in the criterion's unit.
Flow::Fraction Flow::finite_sum(const std::vector<std::int64_t>& rewards) const {
  const Rational d = criterion_.exact_continuation();
  const Integer a(numerator(d));
  const Integer b(denominator(d));
  Integer above = scaled_sum(rewards, 0, rewards.size(), a, b);
  Integer below = pow(b, static_cast<unsigned>(rewards.size() - 1)) * exact_scale_;
  if (criterion_.kind() == Criterion::Kind::discounted) {
    above *= b - a;
    below *= b;
  }
  return {above, below};
}

Flow::Fraction Flow::discounted_gain(std::uint32_t state, double reward, std::uint32_t next) const {
  // Where both courses stand in one state after as many rounds, what follows is the same. So it is once they have paid
  // alike for as long as both cycles take together (Fine & Wilf 1965), nothing being left of the ways to them.
  std::vector<std::int64_t> differences{whole(reward) - whole(rewards_[state])};
  std::uint32_t after = next;
  std::uint32_t before = next_[state];
  const std::size_t laps = cycles_[cycle_of_[after]].size() + cycles_[cycle_of_[before]].size();
  const std::size_t ways = std::max(rounds_to_cycle_[after], rounds_to_cycle_[before]);
  std::size_t alike = 0;
  for (std::size_t round = 0; after != before && alike < laps; ++round) {
    differences.push_back(whole(rewards_[after]) - whole(rewards_[before]));
    if (round >= ways) {
      if (differences.back() != 0) break;
      ++alike;
    }
    after = next_[after];
    before = next_[before];
  }
  if (after == before || alike == laps) {
    while (differences.size() > 1 && differences.back() == 0) differences.pop_back();
    return finite_sum(differences);
  }
  differences.resize(1);
  const Fraction now = finite_sum(differences);
  const Fraction gained = discounted_sum(course_from(next));
  const Fraction lost = discounted_sum(course_from(next_[state]));
  const Rational d = criterion_.exact_continuation();
  const Integer a(numerator(d));
  const Integer below = gained.below * lost.below * denominator(d);
  const Integer later = a * (gained.above * lost.below - lost.above * gained.below);
  return {now.above * below + later * now.below, now.below * below};
}

Rational Flow::gain(std::uint32_t state, double reward, std::uint32_t next) const {
  if (criterion_.kind() == Criterion::Kind::mean) return value(next) - value(state);
  const Fraction gained = discounted_gain(state, reward, next);
  return {gained.above, gained.below};
}

int Flow::gain_sign(std::uint32_t state, double reward, std::uint32_t next) const {
  if (criterion_.kind() == Criterion::Kind::mean) return gain(state, reward, next).sign();
  return discounted_gain(state, reward, next).above.sign();
}

double Flow::rounded_gain(std::uint32_t state, double reward, std::uint32_t next) const {
  if (criterion_.kind() == Criterion::Kind::mean) return values_[next] - values_[state];
  const double weight = first_weight(criterion_);
  return weight * reward / scale_ + criterion_.continuation() * values_[next] - values_[state];
}

}  // namespace folk
