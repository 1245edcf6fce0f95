#pragma once
// Discounted payoffs of deterministic plans as functions of the discount factor d.

#include <folk/analysis/thresholds/polynomial.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace folk {

/// A plan that earns payoff[s] in state s and goes on to next[s]: from each state on, payoffs that are periodic in the
/// end, so that their sum discounted by d is a quotient of polynomials, with 1 - d^period below.
class PlanPayoffs {
public:
  /// Both vectors have an entry a state; `next` stays among the states.
  PlanPayoffs(std::vector<std::uint32_t> next, std::vector<Integer> payoff);

  std::uint32_t next(std::uint32_t state) const { return next_[state]; }
  const Integer& payoff(std::uint32_t state) const { return payoff_[state]; }

  /// Rounds until the payoffs are periodic, and their period, the smallest.
  std::size_t rounds_before(std::uint32_t state) const { return before_[state]; }
  std::size_t period(std::uint32_t state) const { return period_[state]; }

  /// payoff + d payoff' + d^2 payoff'' + ... from each state on, by doubles.
  std::vector<double> values(double d) const;

private:
  void close_cycle(const std::vector<std::uint32_t>& cycle);

  std::vector<std::uint32_t> next_;
  std::vector<Integer> payoff_;
  std::vector<std::size_t> before_;
  std::vector<std::size_t> period_;  // 0: not yet known
  std::vector<std::vector<std::uint32_t>> cycles_;
  std::vector<std::uint32_t> outside_;  // states on no cycle, each after its successor
};

/// `now` in this round, and from the next on what `plan` earns from `then`.
struct Prospect {
  const PlanPayoffs& plan;
  const Integer& now;
  std::uint32_t then = 0;
};

/// A polynomial with the sign, on (0, 1), of what `a` is worth more than `b`: their difference times
/// (1 - d^k)(1 - d^l) / (1 - d^gcd(k, l)), k and l being the periods; the difference itself where it ends. Nothing when
/// more than `most_terms` coefficients would have to be looked at.
std::optional<Polynomial> advantage(const Prospect& a, const Prospect& b, std::size_t most_terms);

}  // namespace folk
