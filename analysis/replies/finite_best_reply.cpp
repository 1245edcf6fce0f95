#include <folk/analysis/play/criterion_table.h>
#include <folk/analysis/play/whole_payoffs.h>
#include <folk/analysis/replies/finite_best_reply.h>
#include <folk/games/error.h>
#include <folk/games/outcome.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

namespace folk {
namespace {

/// The mean of what follows one thing and what follows the other, by their probabilities.
double expected(const std::array<double, 2>& chances, double after_one, double after_other) {
  return chances[0] * after_one + chances[1] * after_other;
}

ReplyProblem problem_within(const Machine& machine, const Payoffs& payoffs, std::uint64_t rounds, Noise noise) {
  if (rounds == 0) throw UsageError("a best reply over 0 rounds is no play: give 1 or more");
  const Sense sense = noise > 0 ? Sense::any_own_moves : Sense::own_moves_its_own;
  ReplyProblem problem = reply_problem(table_for(machine, Criterion::finite(rounds), sense, 0), payoffs, noise);
  if (problem.outside) problem.outside->payoff = 0;  // never played: the match is over
  return problem;
}

}  // namespace

FiniteBestReply::FiniteBestReply(const Machine& opponent, const Payoffs& payoffs, std::uint64_t rounds, Noise noise)
    : FiniteBestReply(problem_within(opponent, payoffs, rounds, noise), rounds) {}

FiniteBestReply::FiniteBestReply(ReplyProblem problem, std::uint64_t rounds)
    : problem_(std::move(problem)),
      rounds_(rounds) {
  if (rounds > most_decisions / problem_.size())
    throw UsageError(fmt::format("a best reply to {} states over {} rounds: more than {} decisions, play fewer rounds",
                                 problem_.size(), rounds, most_decisions));
  solve();
}

void FiniteBestReply::solve() {
  const WholePayoffs whole = whole_payoffs(problem_.payoffs);
  if (!whole.exact(static_cast<double>(rounds_)))
    throw UsageError(fmt::format("{} rounds at {} would score too much to count exactly: play fewer", rounds_,
                                 to_text(problem_.payoffs)));
  const std::size_t states = problem_.size();
  const std::array slip{problem_.noise.probability(), 1 - problem_.noise.probability()};
  const double outside = problem_.outside ? to_double(problem_.outside->payoff) * whole.scale : 0;
  defects_.resize(rounds_ * states);
  // What the best and the worst play earn from each state on in the rounds that are left.
  std::vector<double> most(states, 0);
  std::vector<double> least(states, 0);
  std::vector<double> next_most(states);
  std::vector<double> next_least(states);
  for (std::uint64_t round = rounds_; round-- > 0;) {
    for (std::size_t s = 0; s < states; ++s) {
      if (problem_.is_outside(s)) {
        next_most[s] = most[s] + outside;
        next_least[s] = least[s] + outside;
        continue;
      }
      std::array<double, 2> best{};
      std::array<double, 2> worst{};
      for (const Move own : {Move::C, Move::D}) {
        const auto& p = problem_.states[s].chances;
        const std::size_t c = Outcome{own, Move::C}.index();
        const std::size_t d = Outcome{own, Move::D}.index();
        const auto& next = problem_.states[s].next;
        best[bit(own)] = expected(p, whole.by_outcome[c] + most[next[c]], whole.by_outcome[d] + most[next[d]]);
        worst[bit(own)] = expected(p, whole.by_outcome[c] + least[next[c]], whole.by_outcome[d] + least[next[d]]);
      }
      if (problem_.noise > 0) {
        best = std::array{expected(slip, best[1], best[0]), expected(slip, best[0], best[1])};
        worst = std::array{expected(slip, worst[1], worst[0]), expected(slip, worst[0], worst[1])};
      }
      next_most[s] = std::max(best[0], best[1]);
      next_least[s] = std::min(worst[0], worst[1]);
      defects_[round * states + s] = best[1] > best[0];
    }
    most.swap(next_most);
    least.swap(next_least);
  }
  exact_ = Rational(static_cast<std::int64_t>(most[problem_.start])) / whole.exact_scale;
  optimum_ = most[problem_.start] / whole.scale;
  minimum_ = least[problem_.start] / whole.scale;
}

std::optional<Rational> FiniteBestReply::exact_optimum() const {
  if (!problem_.deterministic() || (problem_.outside && problem_.outside->payoff != 0)) return std::nullopt;
  return exact_;
}

Move FiniteBestReply::best(std::uint64_t round, std::uint32_t state) const {
  return defects_[round * problem_.size() + state] ? Move::D : Move::C;
}

std::vector<Move> FiniteBestReply::moves() const {
  if (!problem_.deterministic()) throw std::logic_error("no sequence of moves is a best reply to a machine that mixes");
  std::vector<Move> moves;
  std::uint32_t state = problem_.start;
  for (std::uint64_t round = 0; round < rounds_; ++round) {
    moves.push_back(best(round, state));
    const Move theirs = problem_.states[state].chance(Move::C) > 0.5 ? Move::C : Move::D;
    state = problem_.states[state].next[Outcome{moves.back(), theirs}.index()];
  }
  return moves;
}

Automaton FiniteBestReply::machine(std::size_t most_states) const {
  std::vector<Automaton::Node> nodes;
  std::map<std::uint32_t, std::uint32_t> layer{{problem_.start, 0}};  // opponent's state -> node, of this round
  for (std::uint64_t round = 0; round < rounds_; ++round) {
    const auto first_of_next = static_cast<std::uint32_t>(nodes.size() + layer.size());
    std::map<std::uint32_t, std::uint32_t> next_layer;
    std::vector<std::uint32_t> states(layer.size());
    for (const auto& [state, node] : layer) states[node - nodes.size()] = state;
    for (const auto state : states) {
      const Move own = best(round, state);
      Automaton::Node node{own == Move::C ? 1.0 : 0.0, {}};
      for (const Outcome outcome : all_outcomes) {
        // Without noise, outcomes of the other own move never come about and repeat those of this one.
        const Outcome met = problem_.noise > 0 ? outcome : Outcome{own, outcome.theirs};
        const auto next = problem_.states[state].next[met.index()];
        const auto [place, fresh] =
            next_layer.emplace(next, static_cast<std::uint32_t>(first_of_next + next_layer.size()));
        node.next[outcome.index()] = place->second;
      }
      nodes.push_back(node);
    }
    if (nodes.size() + next_layer.size() > most_states)
      throw UsageError(
          fmt::format("the best reply over {} rounds has more than {} states as a machine", rounds_, most_states));
    layer = std::move(next_layer);
  }
  const auto end = static_cast<std::uint32_t>(nodes.size());
  for (auto& node : nodes)
    for (auto& next : node.next) next = std::min(next, end);  // all that follows the last round is one state
  nodes.push_back({0, {end, end, end, end}});
  return Automaton(std::move(nodes), 0);
}

}  // namespace folk
