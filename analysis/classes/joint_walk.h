#pragma once
// All matches between two members of a class, their genes revealed one by one as play asks for them.

#include <folk/analysis/classes/path_value.h>
#include <folk/games/outcome.h>
#include <folk/strategies/standard/memory_class.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace folk {

/// Four numbers side by side, for the processor's vector instructions.
template <class Number>
struct FourOf;
template <>
struct FourOf<double> {
  using Lanes = double __attribute__((vector_size(32)));
};
template <>
struct FourOf<std::int64_t> {
  using Lanes = std::int64_t __attribute__((vector_size(32)));
};
template <class Number>
using Lanes = typename FourOf<Number>::Lanes;

/// What a path brings, by lane: the first player's payoff, the second player's, the first player's moves C.
inline constexpr std::size_t own_payoff = 0;
inline constexpr std::size_t their_payoff = 1;
inline constexpr std::size_t own_cooperations = 2;

/// Walks the joint states of two members of one class. Where play asks for a gene that is not fixed, both moves are
/// followed; where a joint state returns, or finite:T is over, the rest is known, and the leaf stands for every member
/// that has the genes asked for, whatever its others are.
///
/// Genes says what is fixed. `genes.first(chosen, gene, move)` notes in `chosen`, a copy of what was chosen for the
/// first player so far, that its gene is `move` (1 for D), and returns false where it cannot be; `genes.second` the
/// same for the second player. `genes.leaf(leaves, second, values)` notes a leaf, its values by lane, in Genes::Leaves;
/// leaves that differ in the second player's last gene alone are then handed to `genes.add(first, leaves)`.
///
/// Number as path_term has it; double is the faster, and as exact as long as whole numbers stay within 2^53.
template <class Number>
class JointWalk {
public:
  /// Longer paths than this do not come about.
  static std::size_t longest_path(const MemoryClass& members, const Criterion& criterion) {
    const std::size_t states = std::size_t{1} << (2 * members.openings());
    const std::size_t longest = members.openings() + states;
    return criterion.is_finite() ? std::min<std::size_t>(longest, criterion.rounds()) : longest;
  }

  /// `payoffs` by outcome, the first player's move first; `common` as path_term has it.
  JointWalk(const MemoryClass& members, const Criterion& criterion, const std::array<double, 4>& payoffs,
            Number common = 1)
      : openings_(members.openings()),
        own_memory_(members.own_memory()),
        their_memory_(members.their_memory()),
        longest_(static_cast<unsigned>(longest_path(members, criterion))),
        stops_(criterion.is_finite() && criterion.rounds() == longest_),
        terms_(criterion, longest_, common),
        weights_(round_weights<Number>(criterion, longest_)),
        marks_(std::size_t{1} << (2 * openings_), 0),
        sums_(longest_ + 1, Lanes<Number>{}) {
    for (std::size_t o = 0; o < 4; ++o) {
      const std::size_t exchanged = all_outcomes[o].exchanged().index();
      rounds_[o] = Lanes<Number>{static_cast<Number>(payoffs[o]), static_cast<Number>(payoffs[exchanged]),
                                 static_cast<Number>(o < 2 ? 1 : 0), 0};
    }
  }

  /// `first` and `second`: what is chosen before the match.
  template <class Genes>
  void run(Genes& genes, const typename Genes::First& first, const typename Genes::Second& second) {
    round(genes, first, second, 0, 0, 0);
  }

private:
  /// Round t (from 0) in a joint state that is new, after the last moves `a` and `b` of both, as many as there are
  /// openings, the oldest highest.
  template <class Genes>
  void round(Genes& genes, const typename Genes::First& first, const typename Genes::Second& second, unsigned t,
             unsigned a, unsigned b) {
    const bool opening = t < openings_;
    const unsigned state = (a << openings_) | b;
    if (!opening) marks_[state] = static_cast<std::uint16_t>(t + 1);
    const unsigned first_gene = opening ? t : entry(a, b);
    const unsigned second_gene = opening ? t : entry(b, a);
    for (unsigned x = 0; x < 2; ++x) {
      auto chosen_first = first;
      if (!genes.first(chosen_first, first_gene, x)) continue;
      typename Genes::Leaves leaves{};
      for (unsigned y = 0; y < 2; ++y) {
        auto chosen_second = second;
        if (!genes.second(chosen_second, second_gene, y)) continue;
        sums_[t + 1] = sums_[t] + weights_[t] * rounds_[2 * x + y];
        const unsigned next_a = ((a << 1U) | x) & low(openings_);
        const unsigned next_b = ((b << 1U) | y) & low(openings_);
        const unsigned mark = t + 1 < openings_ ? 0 : marks_[(next_a << openings_) | next_b];
        if (mark != 0) {
          genes.leaf(leaves, chosen_second, value(mark - 1, t + 1));
        } else if (stops_ && t + 1 == longest_) {
          genes.leaf(leaves, chosen_second, value(t + 1, t + 1));
        } else {
          round(genes, chosen_first, chosen_second, t + 1, next_a, next_b);
        }
      }
      genes.add(chosen_first, leaves);
    }
    if (!opening) marks_[state] = 0;
  }

  Lanes<Number> value(std::size_t begin, std::size_t end) const {
    return terms_(begin, end).value(sums_.data(), begin, end);
  }

  /// The gene that a player asks who did `own` and saw `theirs`.
  unsigned entry(unsigned own, unsigned theirs) const {
    return openings_ + (((own & low(own_memory_)) << their_memory_) | (theirs & low(their_memory_)));
  }

  static unsigned low(unsigned bits) { return (1U << bits) - 1; }

  unsigned openings_;
  unsigned own_memory_;
  unsigned their_memory_;
  unsigned longest_;
  bool stops_;
  PathTerms<Number> terms_;
  std::vector<Number> weights_;            // of rounds
  std::array<Lanes<Number>, 4> rounds_{};  // what a round of each outcome brings
  std::vector<std::uint16_t> marks_;       // of a joint state: one more than the round in which play stood there
  std::vector<Lanes<Number>> sums_;        // prefix sums
};

}  // namespace folk
