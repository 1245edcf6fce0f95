#include <folk/analysis/equilibria/nash_gap.h>
#include <folk/analysis/play/markov_play.h>
#include <folk/games/error.h>
#include <folk/games/outcome.h>

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <set>
#include <utility>

namespace folk {
namespace {

/// Where a reply first does otherwise than the path, both against the same opponent.
Witness first_departure(const PlayPath& path, const Automaton& reply) {
  Witness witness{{}, std::nullopt, "best reply", {}};
  State state = reply.start();
  std::set<State> seen;  // where the reply stood when a lap of the cycle began: it may go along for some laps
  for (std::size_t t = 0;; ++t) {
    if (t == path.rounds.size()) {
      if (!path.cycle || !seen.insert(state).second) return {{}, std::nullopt, "best reply", {}};
      t = *path.cycle;
    }
    const Outcome& round = path.rounds[t];
    if (move_of(reply, state) != round.own) {
      witness.deviation = other(round.own);
      return witness;
    }
    witness.history.push_back(round);
    state = reply.next(state, round.own, round.theirs);
  }
}

}  // namespace

Gap reply_gap(const PlayPath& path, const PathPayoffs& paid, const BestReply& reply) {
  Gap gap;
  if (reply.exact) {
    const Rational gain = *reply.exact - paid.total();
    gap = exact_gap(gain, gain > 0 ? first_departure(path, reply.machine) : Witness{});
  } else {
    gap = rounded_gap(reply.payoff - paid.rounded_from(0), reply.residual + paid.doubt(),
                      first_departure(path, reply.machine));
  }
  if (gap.exact ? *gap.exact > 0 : gap.gain > 0) gap.witness.reply = std::make_shared<const Automaton>(reply.machine);
  if (reply.horizon) gap.depth = *reply.horizon;
  if (path.cut) gap.depth = path.rounds.size();
  return gap;
}

Gap reply_gap(double paid, double rounding, const BestReply& reply) {
  Gap gap = rounded_gap(reply.payoff - paid, reply.residual + rounding, {{}, std::nullopt, "best reply", {}});
  if (gap.gain > 0) gap.witness.reply = std::make_shared<const Automaton>(reply.machine);
  return gap;
}

Gap nash_gap(const PlayPath& path, const Machine& theirs, const Payoffs& payoffs, const Criterion& criterion,
             unsigned horizon) {
  const PathPayoffs paid(path, payoffs, criterion);
  return reply_gap(path, paid, best_reply(theirs, {payoffs, criterion}, horizon));
}

double expected_payoff(const Automaton& own, const Automaton& theirs, const MatchRules& rules) {
  const auto& [payoffs, criterion, noise] = rules;
  const auto pair = play_markov(own, theirs, noise, criterion);
  if (!pair)
    throw UsageError(fmt::format("machines of {} and {} states that {}: too many to solve under {}", own.size(),
                                 theirs.size(), noise > 0 ? "slip" : "mix", criterion.to_string()));
  const auto numbers = payoffs.numbers();
  double payoff = 0;
  for (std::size_t o = 0; o < 4; ++o) payoff += pair->weights[o] * numbers[o];
  return payoff;
}

Gap nash_gap(const Automaton& own, const Automaton& theirs, const MatchRules& rules) {
  return reply_gap(expected_payoff(own, theirs, rules), rounding_of(rules.payoffs, rules.criterion),
                   best_reply(theirs, rules));
}

}  // namespace folk
