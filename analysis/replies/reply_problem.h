#pragma once
// Replying to a known machine as a Markov decision problem on its states, and what solves it.

#include <folk/games/noise.h>
#include <folk/games/outcome.h>
#include <folk/games/payoffs.h>
#include <folk/games/rational.h>
#include <folk/strategies/automaton.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace folk {

/// In each state the opponent plays C with a known probability, and what both moves lead to is known: whoever replies
/// always knows the state, because it is a function of what was really played.
struct ReplyProblem {
  struct State {
    std::array<double, 2> chances{1, 0};  ///< P(the opponent really plays C), and D
    std::array<std::uint32_t, 4> next;    ///< by the replier's outcome (own move first)

    double chance(Move theirs) const { return chances[bit(theirs)]; }
  };

  /// A state that pays the same in every round whatever is played and is never left.
  struct Outside {
    std::uint32_t state = 0;
    Rational payoff;
  };

  std::vector<State> states;
  std::uint32_t start = 0;
  Payoffs payoffs;
  Noise noise;                     ///< the replier's own moves flip with this probability
  std::optional<Outside> outside;  ///< what lies beyond a horizon, or off the path

  std::size_t size() const { return states.size(); }

  /// Nothing happens by chance.
  bool deterministic() const;

  bool is_outside(std::size_t state) const { return outside && outside->state == state; }

  /// What happens when the replier means to play `own`: which outcomes, with which probabilities.
  struct Chance {
    Outcome outcome;
    double probability;
  };
  struct Chances {
    std::array<Chance, 4> chances;
    std::size_t size = 0;
    const Chance* begin() const { return chances.data(); }
    const Chance* end() const { return chances.data() + size; }
  };
  Chances after(std::size_t state, Move own) const;
};

/// The problem of replying to an automaton, each move of both sides flipping with probability `noise`. With noise the
/// automaton must be tabulated in the sense any_own_moves. The state beyond the automaton's horizon, if there is one,
/// pays the least payoff of the game: what a reply earns is never overstated.
ReplyProblem reply_problem(const Automaton& opponent, const Payoffs& payoffs, Noise noise = {});

/// A best move in every state of a reply problem, and what it is worth from there on.
struct StationaryReply {
  std::vector<Move> moves;            ///< by state; C where both are as good
  std::vector<double> values;         ///< by state, in the criterion's unit (mean: a round)
  double residual = 0;                ///< no reply earns more than values + residual anywhere
  std::optional<Rational> optimum;    ///< from the start on: exact, and proved to be the best; set without chance
  std::vector<Rational> exact_means;  ///< without chance and for mean: the best mean from each state on
};

/// A stationary reply as a machine on the problem's states: what it plays by the state that the opponent is in.
/// The minimised form, in the sense any_own_moves.
Automaton reply_machine(const ReplyProblem& problem, const std::vector<Move>& moves);

}  // namespace folk
