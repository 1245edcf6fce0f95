#pragma once
// Dataset aggregation: what a policy meets, with what Bayes-optimal play would have done there.

#include <folk/analysis/replies/bayes_reply.h>
#include <folk/sct/data/trajectory.h>
#include <folk/sct/data/windows.h>
#include <folk/strategies/strategy.h>

#include <array>
#include <cstdint>
#include <vector>

namespace folk::sct {

/// Labels any play against members of a roster by what Bayes-optimal play wants (DAgger: Ross, Gordon & Bagnell 2011).
class BayesTeacher {
public:
  /// Throws what BayesReply throws. `target`: the return that the policy is asked for at play, unscaled.
  BayesTeacher(const std::vector<Strategy>& roster, const Payoffs& payoffs, std::uint64_t rounds, double target);

  /// The match with the moves as they were played; wanted is the better move given what was known, a round's weight is
  /// what the worse one would have cost (at most most_weight, 0 where both are as good), and the return token holds
  /// what it will hold at play: the target less what was earned so far. Throws UsageError when no member plays so.
  Lesson label(const Trajectory& trajectory) const;

  const BayesReply& reply() const { return reply_; }
  double target() const { return target_; }

  static constexpr double most_weight = 5;

private:
  BayesReply reply_;
  std::array<float, 4> rewards_{};
  double target_;
};

}  // namespace folk::sct
