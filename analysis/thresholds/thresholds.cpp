#include <folk/analysis/thresholds/parametric_reply.h>
#include <folk/analysis/thresholds/plan_payoffs.h>
#include <folk/analysis/thresholds/thresholds.h>
#include <folk/games/error.h>
#include <folk/games/stage_games/minmax.h>
#include <folk/strategies/product.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace folk {
namespace {

/// Payoffs times a common denominator, which changes no sign.
struct Stakes {
  std::array<Integer, 4> payoff;  // by outcome, own move first
  Integer minmax;
};

Stakes stakes_of(const Payoffs& payoffs) {
  const Rational least = minmax(stage_game(payoffs), Seat::first).mixed;
  Integer scale = denominator(least);
  for (const Rational& payoff : payoffs.by_outcome()) scale = lcm(scale, denominator(payoff));
  Stakes stakes;
  for (std::size_t o = 0; o < 4; ++o) stakes.payoff[o] = numerator(payoffs.by_outcome()[o] * scale);
  stakes.minmax = numerator(least * scale);
  return stakes;
}

std::vector<Seat> seats(Sides sides) {
  if (sides == Sides::both) return {Seat::first, Seat::second};
  return {sides == Sides::first ? Seat::first : Seat::second};
}

Move move_at(const Automaton& machine, std::uint32_t state) { return move_of(machine, state); }

/// An outcome as the first machine sees it, or as `seat` does: either one from the other.
Outcome seen_by(Seat seat, Outcome outcome) { return seat == Seat::first ? outcome : outcome.exchanged(); }

/// The outcome, as the first machine sees it, after `seat` changes its move.
Outcome deviated(Seat seat, Outcome outcome) { return seen_by(seat, seen_by(seat, outcome).deviated()); }

Move move_of_seat(Seat seat, Outcome outcome) { return seen_by(seat, outcome).own; }

/// A set that is cut by one deviation after another, and what each of the ends comes from.
class Cutting {
public:
  bool empty() const { return set_.empty(); }
  const DiscountSet& set() const { return set_; }

  /// Keeps the d where p >= 0; `binding` tells what p stands for and is asked only when it matters.
  template <class MakeBinding>
  void cut(const Polynomial& p, MakeBinding binding) {
    if (set_.empty() || !seen_.insert(p.coefficients()).second) return;
    if (set_.cut(p, bindings_.size())) bindings_.push_back(binding());
  }

  Threshold result() && {
    std::vector<Binding> used;
    for (const std::size_t old : set_.renumber_constraints()) used.push_back(std::move(bindings_[old]));
    return {std::move(set_), std::move(used)};
  }

private:
  DiscountSet set_ = DiscountSet::all();
  std::vector<Binding> bindings_;
  std::set<std::vector<Integer>> seen_;
};

/// The play of two machines: outcomes of the rounds until joint states repeat, then again from `loop` on.
struct Path {
  std::vector<Outcome> outcomes;
  std::uint32_t loop = 0;

  std::uint32_t next(std::uint32_t t) const { return t + 1 < outcomes.size() ? t + 1 : loop; }

  std::vector<Outcome> history(std::size_t rounds) const {
    return {outcomes.begin(), outcomes.begin() + static_cast<std::ptrdiff_t>(rounds)};
  }

  PlanPayoffs payoffs(Seat seat, const Stakes& stakes) const {
    std::vector<std::uint32_t> successors;
    std::vector<Integer> earned;
    for (std::uint32_t t = 0; t < outcomes.size(); ++t) {
      successors.push_back(next(t));
      earned.push_back(stakes.payoff[seen_by(seat, outcomes[t]).index()]);
    }
    return {std::move(successors), std::move(earned)};
  }
};

std::optional<Path> path_of(const Automaton& first, const Automaton& second, std::size_t most_states) {
  Path path;
  std::map<std::pair<State, State>, std::uint32_t> rounds;
  State a = first.start();
  State b = second.start();
  for (;;) {
    const auto [place, fresh] = rounds.try_emplace({a, b}, static_cast<std::uint32_t>(path.outcomes.size()));
    if (!fresh) {
      path.loop = place->second;
      return path;
    }
    if (rounds.size() > most_states) return std::nullopt;
    const Move own = move_of(first, a);
    const Move theirs = move_of(second, b);
    path.outcomes.push_back({own, theirs});
    a = first.next(a, own, theirs);
    b = second.next(b, theirs, own);
  }
}

std::optional<Threshold> self_confirming(const Path& path, const Stakes& stakes, Sides sides,
                                         const ThresholdLimits& limits) {
  Cutting cutting;
  const PlanPayoffs punished({0}, {stakes.minmax});
  for (const Seat side : seats(sides)) {
    const PlanPayoffs plan = path.payoffs(side, stakes);
    for (std::uint32_t t = 0; t < path.outcomes.size() && !cutting.empty(); ++t) {
      const Outcome outcome = deviated(side, path.outcomes[t]);
      const auto loss = advantage({plan, plan.payoff(t), plan.next(t)},
                                  {punished, stakes.payoff[seen_by(side, outcome).index()], 0}, limits.terms);
      if (!loss) return std::nullopt;
      cutting.cut(*loss, [&] {
        return Binding{side, path.history(t), move_of_seat(side, outcome), Binding::Then::minmax};
      });
    }
  }
  return std::move(cutting).result();
}

/// Joint states as plans of both machines and with the shortest histories to them.
class JointPlans {
public:
  JointPlans(const Automaton& first, const Automaton& second, std::vector<JointNode> nodes)
      : nodes_(std::move(nodes)),
        reached_by_(nodes_.size()) {
    for (std::uint32_t s = 0; s < nodes_.size(); ++s) {
      outcomes_.push_back({move_at(first, nodes_[s].first), move_at(second, nodes_[s].second)});
      // Nodes are in breadth-first order: the first edge to a later one is the end of a shortest history.
      for (const Outcome outcome : all_outcomes)
        if (const std::uint32_t next = nodes_[s].next[outcome.index()]; next > s && !reached_by_[next])
          reached_by_[next] = {s, outcome};
    }
  }

  std::size_t size() const { return nodes_.size(); }
  Outcome planned(std::uint32_t state) const { return outcomes_[state]; }
  std::uint32_t next(std::uint32_t state, Outcome outcome) const { return nodes_[state].next[outcome.index()]; }

  std::vector<Outcome> history(std::uint32_t state) const {
    std::vector<Outcome> played;
    for (; reached_by_[state]; state = reached_by_[state]->first) played.push_back(reached_by_[state]->second);
    std::reverse(played.begin(), played.end());
    return played;
  }

  PlanPayoffs payoffs(Seat seat, const Stakes& stakes) const {
    std::vector<std::uint32_t> successors;
    std::vector<Integer> earned;
    for (std::uint32_t s = 0; s < size(); ++s) {
      successors.push_back(next(s, planned(s)));
      earned.push_back(stakes.payoff[seen_by(seat, planned(s)).index()]);
    }
    return {std::move(successors), std::move(earned)};
  }

private:
  std::vector<JointNode> nodes_;
  std::vector<Outcome> outcomes_;
  std::vector<std::optional<std::pair<std::uint32_t, Outcome>>> reached_by_;
};

std::optional<Threshold> subgame_perfect(const Automaton& first, const Automaton& second, const Stakes& stakes,
                                         Sides sides, const ThresholdLimits& limits, const Progress& progress) {
  auto nodes = product(first, second, Sense::any_own_moves, limits.joint_states);
  if (!nodes) return std::nullopt;
  const JointPlans joint(first, second, std::move(*nodes));
  Cutting cutting;
  for (const Seat side : seats(sides)) {
    const PlanPayoffs plan = joint.payoffs(side, stakes);
    for (std::uint32_t s = 0; s < joint.size() && !cutting.empty(); ++s) {
      progress.check();
      const Outcome outcome = deviated(side, joint.planned(s));
      const auto loss =
          advantage({plan, plan.payoff(s), plan.next(s)},
                    {plan, stakes.payoff[seen_by(side, outcome).index()], joint.next(s, outcome)}, limits.terms);
      if (!loss) return std::nullopt;
      cutting.cut(*loss, [&] {
        return Binding{side, joint.history(s), move_of_seat(side, outcome), Binding::Then::plan};
      });
    }
  }
  return std::move(cutting).result();
}

/// Discount factors for which no best reply is known yet: open intervals.
class Unknown {
public:
  /// One of them that the set needs, or as near to a point of the set as can be; nothing when none is left.
  std::optional<Rational> sample(const DiscountSet& set) {
    for (const DiscountSet::Interval& part : set.intervals())
      for (const auto& [low, high] : gaps_) {
        if (part.high.at <= low || part.low.at >= high) continue;
        const AlgebraicNumber& from = part.low.at < low ? low : part.low.at;
        const AlgebraicNumber& to = part.high.at > high ? high : part.high.at;
        if (from < to) return rational_between(from, to);
        return from.is_rational() ? from.low() : rational_between(low, from);
      }
    return std::nullopt;
  }

  void remove(const DiscountSet::Interval& known) {
    std::vector<std::pair<AlgebraicNumber, AlgebraicNumber>> rest;
    for (const auto& [low, high] : gaps_) {
      if (known.high.at <= low || known.low.at >= high) {
        rest.emplace_back(low, high);
        continue;
      }
      if (low < known.low.at) rest.emplace_back(low, known.low.at);
      if (known.high.at < high) rest.emplace_back(known.high.at, high);
    }
    gaps_ = std::move(rest);
  }

private:
  std::vector<std::pair<AlgebraicNumber, AlgebraicNumber>> gaps_{{Rational(0), Rational(1)}};
};

/// Where the reply first leaves the path. There is such a round: the reply earns something else.
Binding departure(const Path& path, Seat side, const ReplyDecisions& decisions, const std::vector<Move>& reply,
                  std::uint32_t start) {
  std::uint32_t state = start;
  std::size_t t = 0;
  while (reply[state] == move_of_seat(side, path.outcomes[t])) state = decisions.next(state, reply[state]), ++t;
  return {side, path.history(t), reply[state], Binding::Then::best_reply};
}

/// Cuts until for every d that is left some best reply to `opponent` earns no more than the path: what any reply earns
/// bounds the set from outside, and one that is optimal around some d decides the set there.
bool cut_to_best_replies(Cutting& cutting, const Path& path, Seat side, const Automaton& opponent, const Stakes& stakes,
                         const ThresholdLimits& limits, const Progress& progress) {
  if (opponent.size() > limits.reply_states) return false;
  const ReplyDecisions decisions(opponent, stakes.payoff);
  const PlanPayoffs plan = path.payoffs(side, stakes);
  const auto start = static_cast<std::uint32_t>(opponent.start());
  Unknown unknown;
  while (const auto d = unknown.sample(cutting.set())) {
    progress.check();
    const auto reply = parametric_reply(decisions, *d, limits.terms);
    if (!reply) return false;
    const PlanPayoffs best = decisions.plan(reply->moves);
    const auto loss =
        advantage({plan, plan.payoff(0), plan.next(0)}, {best, best.payoff(start), best.next(start)}, limits.terms);
    if (!loss) return false;
    cutting.cut(*loss, [&] { return departure(path, side, decisions, reply->moves, start); });
    unknown.remove(reply->interval);
  }
  return true;
}

std::optional<Threshold> nash(const Automaton& first, const Automaton& second, const Path& path, const Stakes& stakes,
                              Sides sides, const ThresholdLimits& limits, const Progress& progress) {
  Cutting cutting;
  for (const Seat side : seats(sides))
    if (!cut_to_best_replies(cutting, path, side, side == Seat::first ? second : first, stakes, limits, progress))
      return std::nullopt;
  return std::move(cutting).result();
}

void check(const Automaton& machine) {
  if (!machine.deterministic())
    throw UsageError("a machine that mixes has no exact threshold discount factors: give machines without chance");
  if (machine.beyond())
    throw UsageError("an unrolled machine has no threshold discount factors: give the finite machine itself");
}

}  // namespace

Thresholds thresholds(const Automaton& first, const Automaton& second, const Payoffs& payoffs, Sides sides,
                      const ThresholdLimits& limits, const Progress& progress) {
  check(first);
  check(second);
  const Stakes stakes = stakes_of(payoffs);
  Thresholds found;
  const Automaton first_in_play = minimise(first, Sense::own_moves_its_own);
  const Automaton second_in_play = minimise(second, Sense::own_moves_its_own);
  if (const auto path = path_of(first_in_play, second_in_play, limits.joint_states)) {
    found.self_confirming_unrestricted = self_confirming(*path, stakes, sides, limits);
    progress(1.0 / 3);
    found.nash = nash(first_in_play, second_in_play, *path, stakes, sides, limits, progress);
  }
  progress(2.0 / 3);
  found.subgame_perfect = subgame_perfect(minimise(first, Sense::any_own_moves), minimise(second, Sense::any_own_moves),
                                          stakes, sides, limits, progress);
  progress(1);
  // Each notion implies the next: what holds nowhere settles the stronger ones that met a limit.
  if (!found.nash && found.self_confirming_unrestricted && found.self_confirming_unrestricted->set.empty())
    found.nash = Threshold{};
  if (!found.subgame_perfect && found.nash && found.nash->set.empty()) found.subgame_perfect = Threshold{};
  return found;
}

}  // namespace folk
