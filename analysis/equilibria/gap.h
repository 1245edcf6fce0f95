#pragma once
// How far a pair of strategies is from an equilibrium, and the deviation that shows it.

#include <folk/games/criterion.h>
#include <folk/games/move.h>
#include <folk/games/outcome.h>
#include <folk/games/payoffs.h>
#include <folk/games/rational.h>
#include <folk/strategies/automaton.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace folk {

/// A way to gain, told so that a reader can replay it: play goes as in `history`, then `deviation` is played.
struct Witness {
  std::vector<Outcome> history;   ///< as the deviating player sees it (its own move first)
  std::optional<Move> deviation;  ///< what it plays instead; nothing where no deviation gains
  std::string then;               ///< what follows: "best reply", "minmax 1 for ever", ...
  std::string belief;             ///< the machine that the opponent is believed to be, where that is the question
  std::shared_ptr<const Automaton> reply{};  ///< the best reply that gains, where there is one
};

/// What one side of a pair can gain, 0 or more.
struct Gap {
  /// True when more might be gained than was found.
  bool bounded() const { return depth.has_value() || !tried.empty(); }

  double gain = 0;
  std::optional<Rational> exact;       ///< the same exactly, where nothing happens by chance
  double residual = 0;                 ///< how far the true gain may lie from `gain` (rounding; 0 where exact)
  std::optional<std::uint64_t> depth;  ///< a lower bound only: what lies deeper than this was not tried
  std::string tried{};                 ///< a lower bound only, in words: "replies of 17 opponents"
  Witness witness;
};

/// A gap of 0 or of what is given, exact where `gain` is.
Gap exact_gap(const Rational& gain, Witness witness);
Gap rounded_gap(double gain, double residual, Witness witness);

/// What rounding may do to payoffs that were solved in doubles.
double rounding_of(const Payoffs& payoffs, const Criterion& criterion);

}  // namespace folk
