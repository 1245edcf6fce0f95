#pragma once
// Symmetric 2x2 games by the four letters of the literature, the prisoner's dilemma among them.

#include <folk/games/move.h>
#include <folk/games/rational.h>
#include <folk/games/stage_game.h>

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace folk {

/// Payoffs to oneself: T (own D, their C), R (both C), P (both D), S (own C, their D).
struct Payoffs {
  Rational temptation = 5;
  Rational reward = 3;
  Rational punishment = 1;
  Rational sucker = 0;

  /// By outcome index (games/outcome.h): CC = R, CD = S, DC = T, DD = P.
  std::array<Rational, 4> by_outcome() const { return {reward, sucker, temptation, punishment}; }

  /// The same as the nearest doubles.
  std::array<double, 4> numbers() const {
    return {to_double(reward), to_double(sucker), to_double(temptation), to_double(punishment)};
  }

  bool operator==(const Payoffs&) const = default;
};

/// Checks T > R > P > S. Throws UsageError otherwise.
Payoffs prisoners_dilemma(const Rational& temptation, const Rational& reward, const Rational& punishment,
                          const Rational& sucker);

/// A sentence when 2R <= T + S (taking turns to defect pays as much as cooperation), else nothing.
std::optional<std::string> dilemma_warning(const Payoffs& payoffs);

/// Reads "T=5,R=3,P=1,S=0" (any order, each letter once) as a prisoner's dilemma. Throws UsageError.
Payoffs parse_payoffs(std::string_view text);

/// The same of any symmetric 2x2 game. Throws UsageError.
Payoffs parse_symmetric_payoffs(std::string_view text);

/// What the literature calls a game with payoffs in this order: "prisoner's dilemma" (T > R > P > S), "stag hunt"
/// (R > T >= P > S), "chicken" (T > R > S > P), else "symmetric 2x2 game".
std::string usual_name(const Payoffs& payoffs);

/// "T=5,R=3,P=1,S=0".
std::string to_text(const Payoffs& payoffs);

/// The payoffs as a stage game with actions C and D.
StageGame stage_game(const Payoffs& payoffs, const std::string& title = "Prisoner's dilemma");

/// A symmetric 2x2 game as payoffs, its first action taken as C. Throws UsageError for any other game.
Payoffs symmetric_payoffs(const StageGame& game);

}  // namespace folk
