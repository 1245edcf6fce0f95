#pragma once
// From which patience on is a pair of machines in equilibrium? The exact sets of discount factors.

#include <folk/analysis/thresholds/discount_set.h>
#include <folk/games/outcome.h>
#include <folk/games/payoffs.h>
#include <folk/games/progress.h>
#include <folk/games/seat.h>
#include <folk/strategies/automaton.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace folk {

/// What binds at an end of an interval: a deviation that gains nothing there, and gains beyond it.
struct Binding {
  /// What the deviating side does, or is met with, after its deviation.
  enum class Then {
    minmax,     ///< its mixed stage minmax for ever: the worst that it may believe in off the path
    plan,       ///< both machines go on from the states that the deviation leads to
    best_reply  ///< it goes on with a best reply to the opponent
  };

  Seat side = Seat::first;       ///< who deviates
  std::vector<Outcome> history;  ///< what was played before, as the first machine sees it
  Move deviation = Move::C;      ///< instead of the machine's own move
  Then then = Then::plan;
};

/// Where one notion holds. The constraints of the ends are indices into `bindings`.
struct Threshold {
  DiscountSet set;
  std::vector<Binding> bindings;
};

/// Who must not gain by deviating.
enum class Sides { both, first, second };

/// The three notions; one is missing where its limit was met.
struct Thresholds {
  std::optional<Threshold> nash;
  std::optional<Threshold> subgame_perfect;
  std::optional<Threshold> self_confirming_unrestricted;
};

/// Beyond these no threshold is computed.
struct ThresholdLimits {
  std::size_t joint_states = 16384;  ///< that some history reaches; for the other two notions: on the path
  std::size_t reply_states = 1024;   ///< of the machine that is replied to
  std::size_t terms = 512;           ///< of a polynomial in d before it is reduced
};

/// The sets of d in (0, 1), under the discounted criterion, on which
/// * each side's machine is a best reply to the other at the start (Nash);
/// * no side gains by one deviation after any history that deviations of either or both can reach (subgame perfect; the
///   one-shot deviation principle: Mailath & Samuelson 2006, prop. 2.2.1);
/// * no deviation from the path gains when the opponent's mixed stage minmax follows for ever (self-confirming with
///   unrestricted beliefs: Fudenberg & Levine 1993).
/// Machines are tables in the sense any_own_moves (strategies/automaton.h).
/// `progress` is told of each notion. Throws UsageError for a machine that mixes and for one that was unrolled,
/// Cancelled, and EnvironmentError in a build without FLINT (flint_available).
Thresholds thresholds(const Automaton& first, const Automaton& second, const Payoffs& payoffs,
                      Sides sides = Sides::both, const ThresholdLimits& limits = {},
                      const Progress& progress = nullptr);

}  // namespace folk
