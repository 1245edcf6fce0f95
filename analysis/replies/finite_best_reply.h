#pragma once
// The best reply to a machine over T rounds, by dynamic programming over (rounds left, the machine's state).

#include <folk/analysis/replies/reply_problem.h>
#include <folk/games/move.h>
#include <folk/games/noise.h>
#include <folk/games/payoffs.h>
#include <folk/games/rational.h>
#include <folk/strategies/automaton.h>
#include <folk/strategies/machine.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace folk {

/// What the best (and the worst) reply to a known machine earns over T rounds, and how.
///
/// Backward induction: v(r, s) = max over own moves m of E[u(m, x) + v(r - 1, next(s, x, m))], x the machine's move in
/// state s. Machines that count are unrolled: within T rounds they reach finitely many states. Against a deterministic
/// machine all figures are exact whole multiples of the payoffs' last digit; against one that mixes they are
/// expectations, exact up to rounding.
class FiniteBestReply {
public:
  /// Rounds times states of the opponent beyond this are refused: the policy takes a bit each.
  static constexpr std::uint64_t most_decisions = 2'000'000'000;

  /// Throws UsageError when rounds = 0, on more than most_decisions, on a machine that reaches more than 2^20 states,
  /// and on totals beyond 2^53 in units of the payoffs' last digit.
  FiniteBestReply(const Machine& opponent, const Payoffs& payoffs, std::uint64_t rounds, Noise noise = {});

  /// The same for any reply problem.
  FiniteBestReply(ReplyProblem problem, std::uint64_t rounds);

  /// The largest and the smallest (expected) total over the T rounds, in units of the payoffs.
  double optimum() const { return optimum_; }
  double minimum() const { return minimum_; }

  /// The optimum as an exact number, against a deterministic opponent.
  std::optional<Rational> exact_optimum() const;

  std::uint64_t rounds() const { return rounds_; }

  /// The states that the opponent reaches within T rounds; `best` takes their numbers.
  const ReplyProblem& problem() const { return problem_; }

  /// A best move in a round (0 to T-1) in which the opponent stands in `state`; C where both are as good.
  Move best(std::uint64_t round, std::uint32_t state) const;

  /// The T moves that `best` plays against a deterministic opponent. Throws std::logic_error for one that mixes: a best
  /// reply then depends on what it is seen to do.
  std::vector<Move> moves() const;

  /// The reply as a machine that counts the rounds; after the last one it plays D for ever.
  /// Throws UsageError when it has more than `most_states` states.
  Automaton machine(std::size_t most_states = 1U << 20U) const;

private:
  void solve();

  ReplyProblem problem_;
  std::uint64_t rounds_;
  double optimum_ = 0;
  double minimum_ = 0;
  Rational exact_;             // optimum_ before it was rounded, without chance
  std::vector<bool> defects_;  // round * states + state
};

}  // namespace folk
