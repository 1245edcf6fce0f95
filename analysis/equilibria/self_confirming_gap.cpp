#include <folk/analysis/equilibria/nash_gap.h>
#include <folk/analysis/equilibria/self_confirming_gap.h>
#include <folk/analysis/play/joint_play.h>
#include <folk/analysis/replies/finite_best_reply.h>
#include <folk/analysis/replies/path_payoffs.h>
#include <folk/analysis/replies/stationary_reply.h>
#include <folk/games/error.h>
#include <folk/games/outcome.h>
#include <folk/games/stage_games/minmax.h>
#include <folk/strategies/equivalence.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace folk {
namespace {

std::vector<Outcome> first_rounds(const PlayPath& path, std::size_t count) {
  return {path.rounds.begin(), path.rounds.begin() + static_cast<std::ptrdiff_t>(count)};
}

/// Does the machine play, for certain, what the opponent plays on the path? A machine without end is followed along a
/// cycle for `horizon` rounds at least.
bool agrees(const Machine& machine, const PlayPath& path, unsigned horizon) {
  State state = machine.start();
  const auto follow = [&](const Outcome& round) {
    if (machine.cooperation(state) != (round.theirs == Move::C ? 1 : 0)) return false;
    state = machine.next(state, round.theirs, round.own);
    return true;
  };
  for (const Outcome& round : path.rounds)
    if (!follow(round)) return false;
  if (!path.cycle) return true;
  std::set<State> seen;
  for (std::size_t rounds = path.rounds.size(); machine.finite() || rounds < horizon;) {
    if (!seen.insert(state).second) return true;
    for (std::size_t t = *path.cycle; t < path.rounds.size(); ++t, ++rounds)
      if (!follow(path.rounds[t])) return false;
  }
  return true;
}

/// The reply problem off the path: an own move that `own` never makes where it is leads to v for ever.
ReplyProblem path_problem(const JointPlay& play, const Payoffs& payoffs) {
  ReplyProblem problem;
  problem.payoffs = payoffs;
  const auto outside = static_cast<std::uint32_t>(play.size());
  problem.outside = {outside, mixed_minmax(payoffs)};
  for (std::size_t s = 0; s < play.size(); ++s) {
    ReplyProblem::State state{really_played(play.second_cooperation(s), {}), play.node(s).next};
    for (const Outcome outcome : all_outcomes)
      if (!possible(play.first_cooperation(s), outcome, Sense::own_moves_its_own))
        state.next[outcome.index()] = outside;
    problem.states.push_back(state);
  }
  problem.states.push_back({{1, 0}, {outside, outside, outside, outside}});
  return problem;
}

/// P(C) of both machines is the same after every history that `own` and `theirs` can produce (within T rounds).
bool agrees(const Automaton& own, const Automaton& theirs, const Automaton& member, const Criterion& criterion) {
  using Triple = std::array<std::uint32_t, 3>;
  const auto at = [](const Automaton& automaton) { return static_cast<std::uint32_t>(automaton.start()); };
  std::vector<Triple> layer{{at(own), at(theirs), at(member)}};
  std::set<Triple> seen(layer.begin(), layer.end());
  for (std::uint64_t round = 0; !layer.empty() && (!criterion.is_finite() || round < criterion.rounds()); ++round) {
    std::vector<Triple> next_layer;
    for (const auto& [a, b, c] : layer) {
      const double p = own.nodes()[a].cooperation;
      const double q = theirs.nodes()[b].cooperation;
      if (member.nodes()[c].cooperation != q) return false;
      for (const Outcome outcome : all_outcomes) {
        if (!possible_between(p, q, outcome, Sense::own_moves_its_own)) continue;
        const std::size_t seen_by_them = outcome.exchanged().index();
        const Triple next{own.nodes()[a].next[outcome.index()], theirs.nodes()[b].next[seen_by_them],
                          member.nodes()[c].next[seen_by_them]};
        if (seen.insert(next).second) next_layer.push_back(next);
      }
    }
    layer = std::move(next_layer);
  }
  return true;
}

/// Two machines answer alike after every history that the criterion lets happen; nothing where that is not decided.
std::optional<bool> always_answers_alike(const Machine& a, const Machine& b, const MatchRules& rules) {
  if (&a == &b || rules.noise == 0.5) return true;  // at one half every move is a coin's
  const Comparison found = compare(a, b, Sense::any_own_moves);
  const bool over = rules.criterion.is_finite() && found.depth >= rules.criterion.rounds();  // the match ends before
  if (over || found.equivalence == Equivalence::equivalent) return true;
  return found.equivalence == Equivalence::different ? std::optional(false) : std::nullopt;
}

/// The least gap, some members being left out whose gap is not known: it may be 0.
std::optional<Gap> without(const std::vector<std::string>& left_out, std::optional<Gap> least) {
  if (left_out.empty() || (least && least->gain == 0)) return least;
  Gap unknown;
  unknown.tried = fmt::format("{} left out, without end", fmt::join(left_out, ", "));
  return unknown;
}

double share_of(std::size_t members, const ClassReplies& beliefs) {
  return static_cast<double>(members) / static_cast<double>(beliefs.members().size());
}

/// Keeps the least gap; of equal ones an exact one, then the first.
void keep_least(std::optional<Gap>& least, Gap gap) {
  if (!least || gap.gain < least->gain || (gap.gain == least->gain && least->depth && !gap.depth))
    least = std::move(gap);
}

}  // namespace

Rational mixed_minmax(const Payoffs& payoffs) { return minmax(stage_game(payoffs), Seat::first).mixed; }

Gap unrestricted_gap(const PlayPath& path, const Payoffs& payoffs, const Criterion& criterion) {
  return unrestricted_gap(path, PathPayoffs(path, payoffs, criterion), payoffs);
}

Gap unrestricted_gap(const PlayPath& path, const PathPayoffs& paid, const Payoffs& payoffs) {
  const Rational v = mixed_minmax(payoffs);
  const double rate = to_double(v);
  // Only what may exceed the best of what is surely gained can be the largest. Shares, as weights become tiny.
  double surely = 0;
  for (std::size_t t = 0; t < paid.rounds(); ++t)
    surely = std::max(surely, paid.weight(t) * (paid.rounded_gain(t, rate) - paid.doubt()));
  Rational largest = 0;
  std::size_t at = 0;
  for (std::size_t t = 0; t < paid.rounds(); ++t) {
    const double at_most = paid.rounded_gain(t, rate) + paid.doubt();
    if (at_most < 0 || paid.weight(t) * at_most < surely * (1 - 1e-9)) continue;
    const Rational gain = paid.gain(t, v);
    if (gain > largest) {
      largest = gain;
      at = t;
    }
  }
  Witness witness{first_rounds(path, at), other(path.rounds[at].own), "minmax " + to_text(v) + " for ever", {}};
  Gap gap = exact_gap(largest, std::move(witness));
  if (path.cut) gap.depth = path.rounds.size();
  return gap;
}

Gap unrestricted_gap(const Automaton& own, const Automaton& theirs, const Payoffs& payoffs,
                     const Criterion& criterion) {
  return unrestricted_gap(own, theirs, expected_payoff(own, theirs, {payoffs, criterion}), payoffs, criterion);
}

Gap unrestricted_gap(const Automaton& own, const Automaton& theirs, double paid, const Payoffs& payoffs,
                     const Criterion& criterion) {
  const ReplyProblem problem = path_problem(JointPlay(own, theirs, Sense::own_moves_its_own), payoffs);
  double best = 0;
  double residual = 2 * rounding_of(payoffs, criterion);
  if (criterion.is_finite()) {
    best = FiniteBestReply(problem, criterion.rounds()).optimum();
  } else {
    const StationaryReply reply = stationary_reply(problem, criterion);
    best = reply.values[problem.start];
    residual += reply.residual;
  }
  return rounded_gap(best - paid, residual, {{}, std::nullopt, "best reply along the path, minmax off it", {}});
}

std::optional<Gap> class_gap(const PlayPath& path, ClassReplies& beliefs, const Progress& progress) {
  return class_gap(path, PathPayoffs(path, beliefs.payoffs(), beliefs.criterion()), beliefs, progress);
}

std::optional<Gap> class_gap(const PlayPath& path, const PathPayoffs& paid, ClassReplies& beliefs,
                             const Progress& progress) {
  const bool mean = beliefs.criterion().kind() == Criterion::Kind::mean;
  std::optional<Gap> least;
  std::vector<std::string> left_out;
  for (std::size_t i = 0; i < beliefs.members().size(); ++i) {
    progress(share_of(i, beliefs));
    const Strategy& member = beliefs.members()[i];
    if (!member.machine || !agrees(*member.machine, path, beliefs.horizon())) continue;
    if (mean && beliefs.endless(i)) {
      left_out.push_back(member.name);
      continue;
    }
    Gap gap = reply_gap(path, paid, beliefs.reply(i));
    gap.witness.belief = member.name;
    keep_least(least, std::move(gap));
  }
  return without(left_out, std::move(least));
}

std::optional<Gap> class_gap(const Automaton& own, const Automaton& theirs, ClassReplies& beliefs,
                             const Progress& progress) {
  return class_gap(own, theirs, expected_payoff(own, theirs, beliefs.rules()), beliefs, progress);
}

std::optional<Gap> class_gap(const Automaton& own, const Automaton& theirs, double paid, ClassReplies& beliefs,
                             const Progress& progress) {
  const auto& criterion = beliefs.criterion();
  const double rounding = rounding_of(beliefs.payoffs(), criterion);
  std::optional<Gap> least;
  std::vector<std::string> left_out;
  for (std::size_t i = 0; i < beliefs.members().size(); ++i) {
    progress(share_of(i, beliefs));
    const Strategy& member = beliefs.members()[i];
    if (!member.machine) continue;
    if (beliefs.endless(i)) {
      left_out.push_back(member.name);  // whether it agrees for ever is not known
      continue;
    }
    if (!agrees(own, theirs, beliefs.table(i), criterion)) continue;
    const BestReply& reply = beliefs.reply(i);
    keep_least(least, rounded_gap(reply.payoff - paid, reply.residual + rounding,
                                  {{}, std::nullopt, "best reply", member.name}));
  }
  return without(left_out, std::move(least));
}

std::optional<Gap> class_gap_under_noise(const Machine& theirs, const Gap& nash, const ClassReplies& beliefs,
                                         const Progress& progress) {
  std::vector<std::string> left_out;
  for (std::size_t i = 0; i < beliefs.members().size(); ++i) {
    progress(share_of(i, beliefs));
    const Strategy& member = beliefs.members()[i];
    if (!member.machine) continue;
    const auto same = always_answers_alike(theirs, *member.machine, beliefs.rules());
    if (!same) left_out.push_back(member.name);
    if (!same || !*same) continue;
    Gap gap = nash;
    gap.witness.belief = member.name;
    return gap;
  }
  if (left_out.empty()) return std::nullopt;
  Gap unknown;
  unknown.tried = fmt::format("{} left out, too large to compare", fmt::join(left_out, ", "));
  return unknown;
}

}  // namespace folk
