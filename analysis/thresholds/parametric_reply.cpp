#include <folk/analysis/thresholds/parametric_reply.h>
#include <folk/games/outcome.h>

#include <cmath>
#include <set>
#include <utility>

namespace folk {
namespace {

/// Policy iteration in doubles: optimal up to rounding, which the exact one mends.
std::vector<Move> nearly_optimal(const ReplyDecisions& decisions, double d) {
  std::vector<Move> moves(decisions.size(), Move::D);
  constexpr int most_improvements = 50;
  for (int i = 0; i < most_improvements; ++i) {
    const std::vector<double> value = decisions.plan(moves).values(d);
    bool improved = false;
    for (std::uint32_t s = 0; s < moves.size(); ++s) {
      const Move change = other(moves[s]);
      const double changed = to_double(decisions.payoff(s, change)) + d * value[decisions.next(s, change)];
      if (changed <= value[s] + 1e-9 * (1 + std::abs(value[s]))) continue;
      moves[s] = change;
      improved = true;
    }
    if (!improved) break;
  }
  return moves;
}

/// For each state a polynomial >= 0 where changing the move there once does not pay.
std::optional<std::vector<Polynomial>> optimality(const ReplyDecisions& decisions, const std::vector<Move>& moves,
                                                  std::size_t most_terms) {
  const PlanPayoffs plan = decisions.plan(moves);
  std::vector<Polynomial> conditions;
  for (std::uint32_t s = 0; s < moves.size(); ++s) {
    const Move change = other(moves[s]);
    auto condition = advantage({plan, plan.payoff(s), plan.next(s)},
                               {plan, decisions.payoff(s, change), decisions.next(s, change)}, most_terms);
    if (!condition) return std::nullopt;
    conditions.push_back(std::move(*condition));
  }
  return conditions;
}

}  // namespace

ReplyDecisions::ReplyDecisions(const Automaton& opponent, const std::array<Integer, 4>& payoffs)
    : payoffs_(payoffs) {
  for (const auto& node : opponent.nodes()) {
    const Move theirs = node.cooperation > 0.5 ? Move::C : Move::D;
    std::array<Choice, 2> choice;
    for (const Move own : {Move::C, Move::D})
      choice[bit(own)] = {{own, theirs}, node.next[Outcome{theirs, own}.index()]};
    choices_.push_back(choice);
  }
}

PlanPayoffs ReplyDecisions::plan(const std::vector<Move>& moves) const {
  std::vector<std::uint32_t> successors;
  std::vector<Integer> payoffs;
  for (std::uint32_t s = 0; s < moves.size(); ++s) {
    successors.push_back(next(s, moves[s]));
    payoffs.push_back(payoff(s, moves[s]));
  }
  return {std::move(successors), std::move(payoffs)};
}

std::optional<ParametricReply> parametric_reply(const ReplyDecisions& decisions, const Rational& d,
                                                std::size_t most_terms) {
  std::vector<Move> moves = nearly_optimal(decisions, to_double(d));
  for (;;) {
    const auto conditions = optimality(decisions, moves, most_terms);
    if (!conditions) return std::nullopt;
    bool improved = false;
    for (std::size_t s = 0; s < moves.size(); ++s)
      if ((*conditions)[s].sign_at(d) < 0) {
        moves[s] = other(moves[s]);
        improved = true;
      }
    if (improved) continue;
    DiscountSet where = DiscountSet::all();
    std::set<std::vector<Integer>> seen;
    for (const Polynomial& condition : *conditions) {
      if (!seen.insert(condition.coefficients()).second) continue;
      where.cut(condition);
      where.keep_interval_of(d);
    }
    return ParametricReply{std::move(moves), where.intervals().front()};
  }
}

}  // namespace folk
