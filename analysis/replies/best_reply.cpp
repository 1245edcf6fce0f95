#include <folk/analysis/play/criterion_table.h>
#include <folk/analysis/replies/best_reply.h>
#include <folk/analysis/replies/finite_best_reply.h>
#include <folk/analysis/replies/stationary_reply.h>
#include <folk/games/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace folk {
namespace {

BestReply finite_reply(const FiniteBestReply& reply, const Payoffs& payoffs) {
  const auto exact = reply.exact_optimum();
  // Sums of T expectations: each round rounds by a few units of the last digit of what a total may be.
  double largest = 0;
  for (const double payoff : payoffs.numbers()) largest = std::max(largest, std::abs(payoff));
  const auto rounds = static_cast<double>(reply.rounds());
  const double rounding = 4 * 0x1p-53 * rounds * rounds * largest;
  return {reply.optimum(), exact, exact ? 0 : rounding, std::nullopt, reply.machine()};
}

BestReply stationary_best_reply(const ReplyProblem& problem, const Criterion& criterion, unsigned horizon) {
  StationaryReply reply = stationary_reply(problem, criterion);
  const bool bounded = problem.outside.has_value();
  return {reply.values[problem.start], std::move(reply.optimum), reply.residual,
          bounded ? std::optional(horizon) : std::nullopt, reply_machine(problem, reply.moves)};
}

}  // namespace

BestReply best_reply(const Machine& opponent, const MatchRules& rules, unsigned horizon) {
  const auto& [payoffs, criterion, noise] = rules;
  if (criterion.is_finite())
    return finite_reply(FiniteBestReply(opponent, payoffs, criterion.rounds(), noise), payoffs);
  const Sense sense = noise > 0 ? Sense::any_own_moves : Sense::own_moves_its_own;
  return stationary_best_reply(reply_problem(table_for(opponent, criterion, sense, horizon), payoffs, noise), criterion,
                               horizon);
}

BestReply best_reply_to_table(const Automaton& opponent, const MatchRules& rules, unsigned horizon) {
  const auto& [payoffs, criterion, noise] = rules;
  ReplyProblem problem = reply_problem(opponent, payoffs, noise);
  if (!criterion.is_finite()) return stationary_best_reply(problem, criterion, horizon);
  if (problem.outside) problem.outside->payoff = 0;  // never played: the match is over
  return finite_reply(FiniteBestReply(std::move(problem), criterion.rounds()), payoffs);
}

}  // namespace folk
