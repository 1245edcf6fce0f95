#include <folk/analysis/replies/reply_problem.h>

#include <algorithm>

namespace folk {

bool ReplyProblem::deterministic() const {
  const auto pure = [](const State& state) { return state.chance(Move::C) == 0 || state.chance(Move::C) == 1; };
  return noise == 0 && std::all_of(states.begin(), states.end(), pure);
}

ReplyProblem::Chances ReplyProblem::after(std::size_t state, Move own) const {
  Chances chances;
  for (const Move really : {own, other(own)}) {
    const double own_chance = really == own ? 1 - noise : noise.probability();
    for (const Move theirs : {Move::C, Move::D}) {
      const double chance = own_chance * states[state].chance(theirs);
      if (chance > 0) chances.chances[chances.size++] = {{really, theirs}, chance};
    }
  }
  return chances;
}

ReplyProblem reply_problem(const Automaton& opponent, const Payoffs& payoffs, Noise noise) {
  ReplyProblem problem;
  problem.payoffs = payoffs;
  problem.noise = noise;
  problem.start = static_cast<std::uint32_t>(opponent.start());
  problem.states.reserve(opponent.size());
  for (const auto& node : opponent.nodes()) {
    // The replier's outcome (own, theirs) is the opponent's (theirs, own).
    problem.states.push_back(
        {really_played(node.cooperation, noise), {node.next[0], node.next[2], node.next[1], node.next[3]}});
  }
  if (const auto beyond = opponent.beyond()) {
    const auto by_outcome = payoffs.by_outcome();
    problem.outside = {*beyond, *std::min_element(by_outcome.begin(), by_outcome.end())};
  }
  return problem;
}

Automaton reply_machine(const ReplyProblem& problem, const std::vector<Move>& moves) {
  std::vector<Automaton::Node> nodes;
  nodes.reserve(problem.size());
  for (std::size_t s = 0; s < problem.size(); ++s)
    nodes.push_back({moves[s] == Move::C ? 1.0 : 0.0, problem.states[s].next});
  const Automaton whole(std::move(nodes), problem.start);
  return minimise(*tabulate(whole, Sense::any_own_moves), Sense::any_own_moves);
}

}  // namespace folk
