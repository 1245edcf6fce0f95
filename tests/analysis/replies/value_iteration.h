#pragma once
// Best replies by value iteration: slow, obvious, and sharing nothing with policy iteration.

#include <folk/games/criterion.h>
#include <folk/games/outcome.h>
#include <folk/games/payoffs.h>
#include <folk/strategies/automaton.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace folk::test {

/// What a round weighs: 1-d under discounted:d, else 1.
inline double round_weight(const Criterion& criterion) {
  return criterion.kind() == Criterion::Kind::discounted ? criterion.stopping() : 1;
}

/// Sweeps after which less than 1e-12 of a payoff of 10 is left.
inline int sweeps_of(const Criterion& criterion) {
  return criterion.continuation() == 0 ? 1 : static_cast<int>(-31 / std::log(criterion.continuation())) + 2;
}

/// The best payoff against `opponent` from each of its states on, under discounted or ending, to 1e-11 relative to the
/// criterion's total weight.
inline std::vector<double> reply_values(const Automaton& opponent, const Payoffs& payoffs, const Criterion& criterion,
                                        double noise = 0) {
  const auto numbers = payoffs.numbers();
  const double weight = round_weight(criterion);
  std::vector<double> values(opponent.size());
  for (int sweep = sweeps_of(criterion); sweep > 0; --sweep) {
    std::vector<double> next(opponent.size());
    for (std::size_t s = 0; s < opponent.size(); ++s) {
      std::array<double, 2> worth{};
      for (const Move meant : {Move::C, Move::D})
        for (const Move own : {Move::C, Move::D})
          for (const Move theirs : {Move::C, Move::D}) {
            const double p = opponent.nodes()[s].cooperation;
            const double really_c = p * (1 - noise) + (1 - p) * noise;
            const double chance = (own == meant ? 1 - noise : noise) * (theirs == Move::C ? really_c : 1 - really_c);
            const auto after = opponent.nodes()[s].next[Outcome{theirs, own}.index()];
            worth[bit(meant)] +=
                chance * (weight * numbers[Outcome{own, theirs}.index()] + criterion.continuation() * values[after]);
          }
      next[s] = std::max(worth[0], worth[1]);
    }
    values.swap(next);
  }
  return values;
}

}  // namespace folk::test
