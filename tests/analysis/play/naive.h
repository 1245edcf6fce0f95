#pragma once
// The slow and obvious way to play, which the fast ones must agree with.

#include <folk/analysis/play/pair_result.h>
#include <folk/games/criterion.h>
#include <folk/games/outcome.h>
#include <folk/games/random.h>
#include <folk/strategies/automaton.h>

#include <cstdint>
#include <vector>

namespace folk::test {

/// Weights of the outcomes of `rounds` rounds between deterministic machines, round t weighing continuation^t.
inline OutcomeWeights play_naively(const Machine& a, const Machine& b, std::uint64_t rounds, double continuation = 1) {
  OutcomeWeights weights{};
  State x = a.start();
  State y = b.start();
  double weight = 1;
  for (std::uint64_t t = 0; t < rounds; ++t) {
    const Move own = move_of(a, x);
    const Move theirs = move_of(b, y);
    weights[Outcome{own, theirs}.index()] += weight;
    weight *= continuation;
    x = a.next(x, own, theirs);
    y = b.next(y, theirs, own);
  }
  return weights;
}

/// An automaton of 1 to `most` states; pure, or each state mixing.
inline Automaton random_automaton(RandomStream& random, std::uint32_t most, bool pure) {
  const auto below = [&](std::uint32_t n) { return static_cast<std::uint32_t>(random() % n); };
  const std::uint32_t size = 1 + below(most);
  std::vector<Automaton::Node> nodes(size);
  for (auto& node : nodes) {
    node.cooperation = pure ? below(2) : random.uniform();
    for (auto& successor : node.next) successor = below(size);
  }
  return Automaton(std::move(nodes), below(size));
}

}  // namespace folk::test
