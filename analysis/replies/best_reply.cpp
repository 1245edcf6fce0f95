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

BestReply finite_reply(const Machine& opponent, const MatchRules& rules) {
  const FiniteBestReply reply(opponent, rules.payoffs, rules.criterion.rounds(), rules.noise);
  const auto exact = reply.exact_optimum();
  // Sums of T expectations: each round rounds by a few units of the last digit of what a total may be.
  double largest = 0;
  for (const double payoff : rules.payoffs.numbers()) largest = std::max(largest, std::abs(payoff));
  const auto rounds = static_cast<double>(rules.criterion.rounds());
  const double rounding = 4 * 0x1p-53 * rounds * rounds * largest;
  return {reply.optimum(), exact, exact ? 0 : rounding, std::nullopt, reply.machine()};
}

}  // namespace

BestReply best_reply(const Machine& opponent, const MatchRules& rules, unsigned horizon) {
  if (rules.criterion.is_finite()) return finite_reply(opponent, rules);
  const Sense sense = rules.noise > 0 ? Sense::any_own_moves : Sense::own_moves_its_own;
  const ReplyProblem problem =
      reply_problem(table_for(opponent, rules.criterion, sense, horizon), rules.payoffs, rules.noise);
  StationaryReply reply = stationary_reply(problem, rules.criterion);
  const bool bounded = problem.outside.has_value();
  return {reply.values[problem.start], std::move(reply.optimum), reply.residual,
          bounded ? std::optional(horizon) : std::nullopt, reply_machine(problem, reply.moves)};
}

}  // namespace folk
