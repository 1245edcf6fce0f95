#pragma once
// Play that has only one course: each state pays something and has one successor. Its payoffs are exact.

#include <folk/games/criterion.h>
#include <folk/games/rational.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace folk {

/// The states of two deterministic machines that play each other, or of one and a plan against it, as one player is
/// paid in them. From every state on, play runs into a cycle.
class Flow {
public:
  /// `next[s]`: the successor of state s; `rewards[s]`: what a round there pays, a whole number up to 2^53, in units of
  /// 1/scale, scale a whole number too. `criterion` is discounted, mean or ending.
  Flow(std::vector<std::uint32_t> next, std::vector<double> rewards, const Rational& scale, const Criterion& criterion);

  std::size_t size() const { return next_.size(); }
  std::uint32_t next(std::uint32_t state) const { return next_[state]; }
  double reward(std::uint32_t state) const { return rewards_[state]; }

  /// The payoff from every state on, rounded: the relative error is within a few units of the last digit per state.
  const std::vector<double>& values() const { return values_; }

  /// The payoff from this state on. O(n) big multiplications for discounted and ending, n the length of the course.
  Rational value(std::uint32_t state) const;

  /// What is gained, from `state` on, by once being paid `reward` (in units of 1/scale) and standing in `next`, where
  /// the old course is taken up again: value after less value before. Exact; cheap where the courses soon meet.
  Rational gain(std::uint32_t state, double reward, std::uint32_t next) const;

  /// The sign of that gain: -1, 0 or 1. Quicker than the gain: nothing is brought to lowest terms.
  int gain_sign(std::uint32_t state, double reward, std::uint32_t next) const;

  /// The same rounded.
  double rounded_gain(std::uint32_t state, double reward, std::uint32_t next) const;

  /// A rounded gain further from 0 than this has the right sign.
  double doubt() const { return doubt_; }

private:
  struct Course {
    std::vector<std::int64_t> rewards;  // before the cycle, then once around it
    std::size_t cycle = 0;              // where it begins
  };
  struct Fraction {  // not in lowest terms
    Integer above;
    Integer below;  // > 0
  };

  void find_cycles();
  void evaluate();
  Course course_from(std::uint32_t state) const;
  Fraction discounted_sum(const Course& course) const;
  Fraction finite_sum(const std::vector<std::int64_t>& rewards) const;
  Fraction discounted_gain(std::uint32_t state, double reward, std::uint32_t next) const;

  std::vector<std::uint32_t> next_;
  std::vector<double> rewards_;
  Integer exact_scale_;
  double scale_;
  Criterion criterion_;
  std::vector<std::uint32_t> cycle_of_;  // the number of the cycle that play runs into
  std::vector<std::uint32_t> rounds_to_cycle_;
  std::vector<std::vector<std::uint32_t>> cycles_;
  std::vector<std::uint32_t> order_;  // states before their successors, cycles left out
  std::vector<double> values_;
  double doubt_ = 0;
};

}  // namespace folk
